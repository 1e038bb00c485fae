#pragma once
// The edges in the plane of a cut where the kept faces end. For caps only.

#include "geometry/clip/cap.hpp"

namespace facetmill {

/// Undirected edges in the plane with the net count of kept faces that run along them, ascending by (low,
/// high).
struct CutSection {
    struct Edge {
        Index low, high;             ///< vertices
        Index low_wedge, high_wedge; ///< of the first kept face along the edge
        int count;                   ///< uses from low to high minus uses from high to low; never 0
    };
    std::vector<Edge> edges;

    /// The edge between two vertices, or none.
    Index number(Index low, Index high) const;
};

/// The section of one side: at every edge outside of it the directions of the kept faces cancel, when they do
/// so in the mesh.
CutSection find_section(const PlaneCut& cut, int side, const Pieces& pieces);

/// Removes contours that do not close (connected edges with a vertex where not as many arrive as leave), and
/// says where they end, in order of their lowest vertex.
std::vector<OpenEnd> drop_open_contours(CutSection& section, const PlaneCut& cut);

} // namespace facetmill
