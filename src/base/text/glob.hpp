#pragma once
// Shell-like patterns: * (any run of characters), ? (one character), [abc], [a-z], [!a]. A backslash makes
// the next character literal. Paths also have alternatives within a component: *.{obj,glb}.

#include <filesystem>
#include <string_view>
#include <vector>

namespace facetmill {

/// True if the text contains a wildcard, or alternatives in braces.
bool is_glob(std::string_view text);

/// True if the pattern matches the whole text. The time is at most proportional to pattern length times text
/// length.
bool glob_matches(std::string_view pattern, std::string_view text);

/// True if a path matches the pattern component by component; ** matches any number of components.
bool glob_matches_path(const std::filesystem::path& pattern, const std::filesystem::path& path);

/// The files that match a path with patterns in any of its components, sorted by their bytes. ** matches any
/// number of directories, and at the end all files below. Hidden files only match a pattern that starts with
/// a dot. A path without patterns returns itself, whether it exists or not, and so does the name of an
/// existing file ("[a].ply").
[[nodiscard]] std::vector<std::filesystem::path> expand_glob(const std::filesystem::path& pattern);

} // namespace facetmill
