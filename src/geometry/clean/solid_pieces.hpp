#pragma once
// Which faces belong to one solid.

#include "mesh/topology.hpp"

namespace facetmill {

/// The pieces of a mesh that hang together over edges, a cavity with the solid around it: a closed piece that
/// looks inward (its volume is negative) belongs to the innermost closed outward piece that it lies in, if
/// there is one. Inside is decided exactly, by a ray from one of its vertices. Numbered by first face. Pieces
/// that are open, or whose faces disagree, stand for themselves. O(n log n).
Components solid_pieces(const Mesh& mesh);

} // namespace facetmill
