#pragma once
// Short names of files for headings, where the whole path does not fit.

#include <string>
#include <utility>

namespace facetmill {

/// The last component of a path, ignoring a trailing slash; "standard input" for "-".
[[nodiscard]] std::string short_name(const std::string& path);

/// The shortest names that distinguish two files or folders: their last components or, if these are equal,
/// the last differing components before them: "old/.../a.glb" and "new/.../a.glb". Equal files have equal
/// names.
[[nodiscard]] std::pair<std::string, std::string> short_names(const std::string& a, const std::string& b);

} // namespace facetmill
