#pragma once
// Divides the faces of a mesh into a tree by count.

#include "mesh/mesh.hpp"

#include <string>
#include <vector>

namespace facetmill {

/// A node of the tree.
struct FaceCut {
    std::string name; ///< a digit for each step from the root
    std::vector<std::size_t> children;
    Index first_leaf = 0,
          last_leaf = 0; ///< range of leaves below the node, or the leaf's own number: first to last - 1
};

struct FaceCuts {
    std::vector<FaceCut> tiles; ///< each node before its children; the root is first
    std::vector<Index> leaf_of_face;
    std::size_t leaves = 0;
};

/// Divides the faces recursively by their centres, along the longest side, among up to four children of a
/// node. The result has as few leaves of at most `most` (1 or more) faces as possible, about equally full.
/// Most nodes have four children, so the numbers of nodes and levels are minimal. Ties follow the order of
/// the faces.
[[nodiscard]] FaceCuts cut_faces(const Mesh& mesh, std::size_t most);

} // namespace facetmill
