#pragma once
// The faces of a mesh in a tree, by count.

#include "mesh/mesh.hpp"

#include <string>
#include <vector>

namespace facetmill {

/// A node of the tree.
struct FaceCut {
    std::string name; ///< a digit for each step from the root
    std::vector<std::size_t> children;
    Index first_leaf = 0, last_leaf = 0; ///< the leaves below it, or its own number: first to last - 1
};

struct FaceCuts {
    std::vector<FaceCut> tiles; ///< each before its children, the root first
    std::vector<Index> leaf_of_face;
    std::size_t leaves = 0;
};

/// Parts the faces by their centres, along the longest side of those, among up to four children of a node,
/// and so on, into as few leaves of at most `most` (1 or more) as there can be, each about as full. Most
/// nodes have four children, so there are no more of them, and no more levels, than so many leaves need. Ties
/// go by the order of the faces.
[[nodiscard]] FaceCuts cut_faces(const Mesh& mesh, std::size_t most);

} // namespace facetmill
