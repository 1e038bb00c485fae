#include "platform/free_space.hpp"

#include <cerrno>
#include <windows.h>

namespace facetmill {

std::optional<std::uint64_t> free_space(const std::filesystem::path& folder) {
    ULARGE_INTEGER bytes{};
    if (!::GetDiskFreeSpaceExW(folder.c_str(), &bytes, nullptr, nullptr)) return {};
    return bytes.QuadPart;
}

bool means_no_space(int error) { return error == ENOSPC || error == EFBIG; }

} // namespace facetmill
