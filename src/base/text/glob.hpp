#pragma once
// Shell-like patterns: * (any run of characters), ? (one character), [abc], [a-z], [!a]. A backslash takes
// the next character as it is.

#include <filesystem>
#include <string_view>
#include <vector>

namespace facetmill {

/// Whether the text holds a character that makes it a pattern.
bool is_glob(std::string_view text);

/// Whether the pattern matches the whole text. Time is at most pattern times text, whatever the pattern.
bool glob_matches(std::string_view pattern, std::string_view text);

/// Whether a path is one that a pattern names: component by component, ** being any number of them.
bool glob_matches_path(const std::filesystem::path& pattern, const std::filesystem::path& path);

/// The files that match a path with patterns in any of its components, sorted by their bytes. ** matches any
/// number of directories, and at the end all files below. Hidden files only match a pattern that starts with
/// a dot. A path without patterns returns itself, whether it exists or not, and so does the name of an
/// existing file ("[a].ply").
std::vector<std::filesystem::path> expand_glob(const std::filesystem::path& pattern);

} // namespace facetmill
