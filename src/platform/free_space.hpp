#pragma once
// Free disk space.

#include <cstdint>
#include <filesystem>
#include <optional>

namespace facetmill {

/// The bytes that this user may still write in the folder. None if the system does not report it.
[[nodiscard]] std::optional<std::uint64_t> free_space(const std::filesystem::path& folder);

} // namespace facetmill
