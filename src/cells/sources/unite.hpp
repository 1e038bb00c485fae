#pragma once
// Vertices that several pieces of a mesh have.

#include "mesh/mesh.hpp"

namespace facetmill::cells {

/// Makes those of the vertices `some` one that have the same name and position: the first stays. The mesh
/// has no seams. Names follow. Returns the vertices that stay, by their old numbers.
std::vector<Index> unite(Mesh& mesh, std::vector<std::uint64_t>& names, std::vector<Index> some);

} // namespace facetmill::cells
