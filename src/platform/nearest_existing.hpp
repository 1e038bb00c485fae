#pragma once
// Finds the existing part of a path.

#include <filesystem>

namespace facetmill {

/// The path itself, or its nearest existing ancestor; "." for a relative path without one.
[[nodiscard]] inline std::filesystem::path nearest_existing(std::filesystem::path path) {
    std::error_code ignored;
    while (!path.empty() && !std::filesystem::exists(path, ignored))
        path = path.has_relative_path() ? path.parent_path() : "/";
    return path.empty() ? "." : path;
}

} // namespace facetmill
