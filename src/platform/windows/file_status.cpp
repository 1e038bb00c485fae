#include "platform/file_status.hpp"

#include "platform/windows/handle.hpp"
#include "platform/windows/last_error.hpp"

namespace facetmill {

namespace {

/// Windows counts time in units of 100 nanoseconds since 1601.
constexpr std::int64_t nanoseconds_in_unit = 100, units_from_1601_to_1970 = 116'444'736'000'000'000;

std::int64_t time_in(const LARGE_INTEGER& time) {
    return (time.QuadPart - units_from_1601_to_1970) * nanoseconds_in_unit;
}

std::uint64_t joined(DWORD high, DWORD low) { return std::uint64_t{high} << 32 | low; }

std::optional<FileStatus> status_in(HANDLE handle) {
    FileStatus status;
    const DWORD type = ::GetFileType(handle);
    if (type != FILE_TYPE_DISK) {
        if (type == FILE_TYPE_UNKNOWN && ::GetLastError() != NO_ERROR) {
            failed_by_last_error();
            return {};
        }
        status.kind = type == FILE_TYPE_PIPE ? FileKind::pipe : FileKind::device;
        return status;
    }
    BY_HANDLE_FILE_INFORMATION about{};
    FILE_BASIC_INFO times{};
    if (!::GetFileInformationByHandle(handle, &about) ||
        !::GetFileInformationByHandleEx(handle, FileBasicInfo, &times, sizeof times)) {
        failed_by_last_error();
        return {};
    }
    const bool is_folder = (about.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
    const bool is_link = (about.dwFileAttributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0;
    status.kind = is_folder ? FileKind::folder : is_link ? FileKind::other : FileKind::regular;
    status.stamp = {joined(about.nFileSizeHigh, about.nFileSizeLow), about.dwVolumeSerialNumber,
                    joined(about.nFileIndexHigh, about.nFileIndexLow), time_in(times.LastWriteTime),
                    time_in(times.ChangeTime)};
    status.permissions = 0666;
    return status;
}

std::optional<FileStatus> status_at(const std::filesystem::path& path, DWORD flags) {
    constexpr DWORD shared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
    const HANDLE handle = ::CreateFileW(path.c_str(), FILE_READ_ATTRIBUTES, shared, nullptr, OPEN_EXISTING,
                                        FILE_FLAG_BACKUP_SEMANTICS | flags, nullptr);
    if (handle == INVALID_HANDLE_VALUE) {
        failed_by_last_error();
        return {};
    }
    const auto status = status_in(handle);
    ::CloseHandle(handle);
    return status;
}

} // namespace

/// Access lists protect folders of users. Files in them have no other owner by default.
bool FileStatus::is_own() const { return true; }

std::optional<FileStatus> status_of(const std::filesystem::path& path) { return status_at(path, 0); }

std::optional<FileStatus> status_of(const Descriptor& file) { return status_in(handle_of(file)); }

std::optional<FileStatus> status_of_link(const std::filesystem::path& path) {
    return status_at(path, FILE_FLAG_OPEN_REPARSE_POINT);
}

/// A new file inherits the access list of its folder.
void take_permissions(const Descriptor&, const FileStatus&) {}

} // namespace facetmill
