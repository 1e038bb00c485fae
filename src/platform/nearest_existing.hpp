#pragma once
// Where a path that may not be there yet will be.

#include <filesystem>

namespace facetmill {

/// The path itself, or the nearest folder above it that is there; "." for a relative one of which nothing is.
inline std::filesystem::path nearest_existing(std::filesystem::path path) {
    std::error_code ignored;
    while (!path.empty() && !std::filesystem::exists(path, ignored))
        path = path.has_relative_path() ? path.parent_path() : "/";
    return path.empty() ? "." : path;
}

} // namespace facetmill
