#include "platform/file_names.hpp"

#include "platform/temporary_files.hpp"
#include "platform/windows/last_error.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>
#include <windows.h>

namespace facetmill {

namespace fs = std::filesystem;

namespace {

bool may_open(const fs::path& path, DWORD access) {
    constexpr DWORD shared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
    const HANDLE handle = ::CreateFileW(path.c_str(), access, shared, nullptr, OPEN_EXISTING,
                                        FILE_FLAG_BACKUP_SEMANTICS, nullptr);
    if (handle == INVALID_HANDLE_VALUE) return failed_by_last_error();
    ::CloseHandle(handle);
    return true;
}

/// Also replaces a file that is open (Windows 10, version 1607). False if the file system cannot.
bool rename_over_open_file(const fs::path& from, const fs::path& to) {
    constexpr DWORD shared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
    const fs::path whole = fs::absolute(to).make_preferred();
    const std::size_t name_bytes = whole.native().size() * sizeof(wchar_t);
    std::vector<std::byte> room(sizeof(FILE_RENAME_INFO) + name_bytes);
    auto* info = reinterpret_cast<FILE_RENAME_INFO*>(room.data());
    info->Flags = FILE_RENAME_FLAG_REPLACE_IF_EXISTS | FILE_RENAME_FLAG_POSIX_SEMANTICS;
    info->FileNameLength = static_cast<DWORD>(name_bytes);
    std::memcpy(info->FileName, whole.c_str(), name_bytes);
    const HANDLE handle = ::CreateFileW(from.c_str(), DELETE | SYNCHRONIZE, shared, nullptr, OPEN_EXISTING,
                                        FILE_FLAG_BACKUP_SEMANTICS | FILE_FLAG_OPEN_REPARSE_POINT, nullptr);
    if (handle == INVALID_HANDLE_VALUE) return false;
    constexpr auto rename_extended = static_cast<FILE_INFO_BY_HANDLE_CLASS>(22); // FileRenameInfoEx
    const bool done =
        ::SetFileInformationByHandle(handle, rename_extended, info, static_cast<DWORD>(room.size())) != 0;
    ::CloseHandle(handle);
    return done;
}

/// Moves an open file away first, for file systems that cannot replace it. Others keep reading the old file.
bool rename_after_moving_away(const fs::path& from, const fs::path& to) {
    const fs::path aside =
        to.parent_path() / temporary_name(to, static_cast<int>(::GetTickCount() & 0x7fffffffU) | 1);
    if (!::MoveFileExW(to.c_str(), aside.c_str(), 0)) return false;
    if (!::MoveFileExW(from.c_str(), to.c_str(), 0)) {
        ::MoveFileExW(aside.c_str(), to.c_str(), 0);
        return false;
    }
    ::DeleteFileW(aside.c_str());
    return true;
}

} // namespace

bool rename_file(const fs::path& from, const fs::path& to) noexcept try {
    if (rename_over_open_file(from, to)) return true;
    // Virus scanners and indexers open new files for a moment, without sharing them.
    constexpr int attempts = 20;
    constexpr DWORD pause = 25; // milliseconds
    for (int attempt = 1;; ++attempt) {
        if (::MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_REPLACE_EXISTING)) return true;
        const DWORD error = ::GetLastError();
        const bool is_busy = error == ERROR_SHARING_VIOLATION || error == ERROR_ACCESS_DENIED;
        if (is_busy && rename_after_moving_away(from, to)) return true;
        ::SetLastError(error);
        if (!is_busy || attempt == attempts) return failed_by_last_error();
        ::Sleep(pause);
    }
} catch (...) { // no memory
    errno = ENOMEM;
    return false;
}

bool remove_file(const fs::path& path) noexcept {
    return ::DeleteFileW(path.c_str()) ? true : failed_by_last_error();
}

bool remove_folder(const fs::path& path) noexcept {
    return ::RemoveDirectoryW(path.c_str()) ? true : failed_by_last_error();
}

bool make_folder(const fs::path& path, unsigned) {
    return ::CreateDirectoryW(path.c_str(), nullptr) ? true : failed_by_last_error();
}

bool touch_file(const fs::path& path) {
    constexpr DWORD shared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
    const HANDLE handle = ::CreateFileW(path.c_str(), FILE_WRITE_ATTRIBUTES, shared, nullptr, OPEN_EXISTING,
                                        FILE_FLAG_BACKUP_SEMANTICS | FILE_FLAG_OPEN_REPARSE_POINT, nullptr);
    if (handle == INVALID_HANDLE_VALUE) return failed_by_last_error();
    FILETIME now{};
    ::GetSystemTimeAsFileTime(&now);
    const bool done = ::SetFileTime(handle, nullptr, &now, &now) ? true : failed_by_last_error();
    ::CloseHandle(handle);
    return done;
}

fs::path comparable_name(fs::path path) {
    std::wstring name = path.make_preferred().native();
    if (!name.empty()) ::CharLowerBuffW(name.data(), static_cast<DWORD>(name.size()));
    return name;
}

bool is_reserved_name(const fs::path& path) {
    const fs::path file = path.filename();
    std::wstring name = file.native();
    if (name.empty() || name == L"." || name == L"..") return false;
    if (name.back() == L' ' || name.back() == L'.' || name.find_first_of(L"<>:\"|?*") != name.npos)
        return true;
    name.resize(std::min(name.size(), name.find(L'.')));
    while (name.ends_with(L' ')) name.pop_back();
    name = comparable_name(name).native();
    const bool is_port = name.size() == 4 && (name.starts_with(L"com") || name.starts_with(L"lpt")) &&
                         name.back() >= L'1' && name.back() <= L'9';
    return is_port || name == L"con" || name == L"prn" || name == L"aux" || name == L"nul" ||
           name == L"conin$" || name == L"conout$";
}

bool may_read(const fs::path& path) { return may_open(path, FILE_READ_DATA); }

bool may_write(const fs::path& path) { return may_open(path, FILE_WRITE_DATA); }

bool may_run(const fs::path& path) { return may_open(path, FILE_EXECUTE); }

bool may_write_in(const fs::path& folder) { return may_open(folder, FILE_ADD_FILE); }

} // namespace facetmill
