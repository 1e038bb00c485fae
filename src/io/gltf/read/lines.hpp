#pragma once
// The lines of a glTF document.

#include "mesh/mesh.hpp"

#include <cstdint>
#include <vector>

namespace facetmill::io::gltf {

/// The two ends of each line of a primitive with this mode. An incomplete last pair of a list is ignored.
[[nodiscard]] std::vector<Index> ends_of_lines(const std::vector<Index>& indices, std::uint64_t mode);

} // namespace facetmill::io::gltf
