#pragma once
// Merges vertices shared by several pieces of a mesh.

#include "mesh/mesh.hpp"

namespace facetmill::cells {

/// Merges vertices among `some` with the same name and position into the first. The mesh has no seams.
/// Updates names. Returns the old numbers of the remaining vertices.
std::vector<Index> unite(Mesh& mesh, std::vector<std::uint64_t>& names, std::vector<Index> some);

} // namespace facetmill::cells
