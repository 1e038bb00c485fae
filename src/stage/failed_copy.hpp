#pragma once
// A copy of a scene that shows where it fails.

#include "stage/assertions.hpp"

#include <filesystem>

namespace facetmill {

/// Adds E-FORMAT when no codec writes such a file.
void verify_failed_copy(const std::string& path, const Value& given, Problems& problems);

/// Writes the scene at once, with the faces that speak against the assertions (against edges and vertices:
/// the faces there) in a red material `failed` and 1 in the face attribute `failed`. Throws output.
void write_failed_copy(const Scene& scene, const Assertions& assertions, const std::filesystem::path& path);

/// The same as a scene.
Scene failed_copy(const Scene& scene, const Assertions& assertions);

} // namespace facetmill
