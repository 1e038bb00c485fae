#pragma once
// Free disk space, and errors without it.

#include <cstdint>
#include <filesystem>
#include <optional>

namespace facetmill {

/// The bytes that this user may still write in the folder. None if the system does not report it.
[[nodiscard]] std::optional<std::uint64_t> free_space(const std::filesystem::path& folder);

/// True if this errno of a failed write means that the disk or the quota of the user is full, or that the
/// file system does not hold larger files.
[[nodiscard]] bool means_no_space(int error);

} // namespace facetmill
