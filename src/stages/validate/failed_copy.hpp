#pragma once
// A copy of a scene that shows where it fails.

#include "stage/assertions.hpp"

#include <filesystem>

namespace facetmill::validate_stage {

/// Adds E-FORMAT when no codec writes such a file.
void verify_failed_copy(const std::string& path, const Value& given, Problems& problems);

/// Sets the flags of the part's faces that speak against the assertion; against edges and vertices: of the
/// faces there.
void flag_faces_against(const Part& part, const Assertion& assertion, std::vector<std::uint32_t>& flags);

/// The scene with the flagged faces of each part in a red material `failed` and 1 in the face attribute
/// `failed`.
Scene failed_copy(const Scene& scene, const std::vector<std::vector<std::uint32_t>>& flags);

/// Writes that at once. Throws output.
void write_failed_copy(const Scene& scene, const std::vector<std::vector<std::uint32_t>>& flags,
                       const std::filesystem::path& path);

} // namespace facetmill::validate_stage
