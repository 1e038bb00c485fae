#pragma once
// A copy of a scene that highlights failures.

#include "stage/assertions.hpp"

#include <filesystem>

namespace facetmill::validate_stage {

/// Adds E-FORMAT if no codec writes the file's format.
void verify_failed_copy(const std::string& path, const Value& given, Problems& problems);

/// Flags the part's faces that violate the assertion; for edges and vertices, the adjacent faces.
void flag_faces_against(const Part& part, const Assertion& assertion, std::vector<std::uint32_t>& flags);

/// The scene with the flagged faces in a red material `failed`, and with 1 in the face attribute `failed`.
[[nodiscard]] Scene failed_copy(const Scene& scene, const std::vector<std::vector<std::uint32_t>>& flags);

/// Writes the copy immediately. Throws an output error.
void write_failed_copy(const Scene& scene, const std::vector<std::vector<std::uint32_t>>& flags,
                       const std::filesystem::path& path);

} // namespace facetmill::validate_stage
