#include "platform/temporary_files.hpp"

#include "platform/file_names.hpp"
#include "platform/windows/handle.hpp"
#include "platform/windows/last_error.hpp"

#include <cerrno>
#include <fmt/format.h>

namespace facetmill {

namespace fs = std::filesystem;

Descriptor unnamed_file(const fs::path& folder) {
    for (int attempt = 0;; ++attempt) {
        const fs::path path = folder / temporary_name("cells", attempt);
        const HANDLE handle = ::CreateFileW(
            path.c_str(), GENERIC_READ | GENERIC_WRITE, FILE_SHARE_DELETE, nullptr, CREATE_NEW,
            FILE_ATTRIBUTE_TEMPORARY | FILE_ATTRIBUTE_HIDDEN | FILE_FLAG_DELETE_ON_CLOSE, nullptr);
        if (handle != INVALID_HANDLE_VALUE) return descriptor_of(handle);
        failed_by_last_error();
        if (errno != EEXIST) return {};
    }
}

fs::path temporary_folder(const std::string& begin_of_name) {
    std::error_code failed;
    const fs::path above = fs::temp_directory_path(failed);
    constexpr int attempts = 1000;
    for (int attempt = 0; attempt < attempts; ++attempt) {
        fs::path folder = above / fmt::format("{}{}-{}", begin_of_name, process_id(), attempt);
        if (make_folder(folder)) return folder;
        if (errno != EEXIST) break;
    }
    return {};
}

int process_id() { return static_cast<int>(::GetCurrentProcessId()); }

bool is_running(int process) {
    const HANDLE handle =
        ::OpenProcess(PROCESS_QUERY_LIMITED_INFORMATION, FALSE, static_cast<DWORD>(process));
    if (!handle) return ::GetLastError() != ERROR_INVALID_PARAMETER;
    DWORD code = 0;
    const bool runs = !::GetExitCodeProcess(handle, &code) || code == STILL_ACTIVE;
    ::CloseHandle(handle);
    return runs;
}

} // namespace facetmill
