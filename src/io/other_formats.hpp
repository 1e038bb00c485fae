#pragma once
// Formats that facetmill neither reads nor writes: descriptions and alternatives.

#include <filesystem>
#include <string>

namespace facetmill::io {

/// How to convert a file of this suffix to a readable format; empty for an unknown or readable suffix.
[[nodiscard]] std::string hint_for_reading(const std::filesystem::path& path);
/// The format to write instead of this suffix; empty for an unknown suffix.
[[nodiscard]] std::string hint_for_writing(const std::filesystem::path& path);

} // namespace facetmill::io
