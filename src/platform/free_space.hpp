#pragma once
// Room on disks.

#include <cstdint>
#include <filesystem>
#include <optional>

namespace facetmill {

/// Bytes that this user may still write in the folder. None where the system does not say.
std::optional<std::uint64_t> free_space(const std::filesystem::path& folder);

} // namespace facetmill
