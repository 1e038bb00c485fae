#include "platform/free_space.hpp"

#include <cerrno>
#include <sys/statvfs.h>

namespace facetmill {

std::optional<std::uint64_t> free_space(const std::filesystem::path& folder) {
    struct statvfs about {};
    if (::statvfs(folder.c_str(), &about) != 0) return {};
    return static_cast<std::uint64_t>(about.f_bavail) * about.f_frsize;
}

bool means_no_space(int error) { return error == ENOSPC || error == EDQUOT || error == EFBIG; }

} // namespace facetmill
