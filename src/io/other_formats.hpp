#pragma once
// Formats that facetmill neither reads nor writes: what they are, and what to use in their place.

#include <filesystem>
#include <string>

namespace facetmill::io {

/// What to do with a file of this suffix that is to be read; empty for a suffix that is not known.
std::string hint_for_reading(const std::filesystem::path& path);
/// What to write in place of a file of this suffix; empty for a suffix that is not known.
std::string hint_for_writing(const std::filesystem::path& path);

} // namespace facetmill::io
