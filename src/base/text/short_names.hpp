#pragma once
// What headings call files, of which the whole path has no room there.

#include <string>
#include <utility>

namespace facetmill {

/// The last component of a path, also of a folder's with a slash behind it; "standard input" for "-".
std::string short_name(const std::string& path);

/// The shortest names that tell two files or folders apart: their last components, or, where these are the
/// same, the last ones that differ before them: "old/.../a.glb" and "new/.../a.glb". One file twice has one
/// name.
std::pair<std::string, std::string> short_names(const std::string& a, const std::string& b);

} // namespace facetmill
