#include "platform/file_names.hpp"

#include <cstdio>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace facetmill {

namespace fs = std::filesystem;

bool rename_file(const fs::path& from, const fs::path& to) noexcept {
    return ::rename(from.c_str(), to.c_str()) == 0;
}

bool remove_file(const fs::path& path) noexcept { return ::unlink(path.c_str()) == 0; }

bool remove_folder(const fs::path& path) noexcept { return ::rmdir(path.c_str()) == 0; }

bool make_folder(const fs::path& path, unsigned permissions) {
    return ::mkdir(path.c_str(), permissions) == 0;
}

bool touch_file(const fs::path& path) {
    return ::utimensat(AT_FDCWD, path.c_str(), nullptr, AT_SYMLINK_NOFOLLOW) == 0;
}

fs::path comparable_name(fs::path path) { return path; }

bool is_reserved_name(const fs::path&) { return false; }

bool may_read(const fs::path& path) { return ::access(path.c_str(), R_OK) == 0; }

bool may_write(const fs::path& path) { return ::access(path.c_str(), W_OK) == 0; }

bool may_run(const fs::path& path) { return ::access(path.c_str(), X_OK) == 0; }

bool may_write_in(const fs::path& folder) { return ::access(folder.c_str(), W_OK | X_OK) == 0; }

} // namespace facetmill
