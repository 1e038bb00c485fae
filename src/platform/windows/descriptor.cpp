#include "platform/descriptor.hpp"

#include "platform/windows/handle.hpp"
#include "platform/windows/last_error.hpp"

namespace facetmill {

namespace {

DWORD access_of(const OpenOptions& options) {
    if (options.is_folder) return FILE_LIST_DIRECTORY;
    const DWORD written = options.appends ? FILE_GENERIC_WRITE & ~DWORD{FILE_WRITE_DATA} : GENERIC_WRITE;
    return options.what == OpenFor::reading   ? GENERIC_READ
           : options.what == OpenFor::writing ? written
                                              : GENERIC_READ | written;
}

DWORD disposition_of(const OpenOptions& options) {
    if (options.create == Create::always) return CREATE_NEW;
    if (options.create == Create::if_missing) return options.truncates ? CREATE_ALWAYS : OPEN_ALWAYS;
    return options.truncates ? TRUNCATE_EXISTING : OPEN_EXISTING;
}

} // namespace

Descriptor Descriptor::borrowed(int number) {
    Descriptor file(number);
    file.is_borrowed_ = true;
    return file;
}

bool Descriptor::close() noexcept {
    const int number = std::exchange(number_, -1);
    return number < 0 || is_borrowed_ || ::_close(number) == 0;
}

Descriptor open_file(const std::filesystem::path& path, const OpenOptions& options) {
    // Others may rename, replace and remove the file while it is open, as on other systems.
    constexpr DWORD shared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
    const DWORD links = options.follows_links ? 0 : FILE_FLAG_OPEN_REPARSE_POINT;
    const HANDLE handle = ::CreateFileW(path.c_str(), access_of(options), shared, nullptr,
                                        disposition_of(options), FILE_FLAG_BACKUP_SEMANTICS | links, nullptr);
    if (handle == INVALID_HANDLE_VALUE) {
        failed_by_last_error();
        return {};
    }
    return descriptor_of(handle, options.appends ? _O_APPEND : 0);
}

Descriptor duplicate(const Descriptor& file) { return Descriptor(::_dup(file.number())); }

} // namespace facetmill
