#pragma once
// Makes caps that close a clipped mesh in the plane of the cut. Only clip uses it.

#include "geometry/cut/cut.hpp"

namespace facetmill {

/// Points that a cap adds to the cut, numbered after the points of PlaneCut. At these points, contours cross
/// or pass through each other's points.
struct ExtraPoints {
    std::vector<Vec3> points;        ///< [extra vertices]
    Provenance vertices, wedges;     ///< mixes only; wedges stays empty without seams
    std::vector<Index> wedge_vertex; ///< [extra wedges] vertices; empty without seams
};

/// A contour of the cut that does not close.
struct OpenEnd {
    std::size_t edges = 0;
    Vec3 at;
};

struct Cap {
    std::vector<Index> corners;  ///< vertices, three by three
    std::vector<Index> vertices; ///< the vertices that the corners use, ascending
    std::vector<Index> wedges;   ///< the walls' wedge at each of these vertices
    ExtraPoints extra;
    bool overlaps = false; ///< contours cross, or go round a region twice: the mesh intersects itself
    std::vector<OpenEnd> open;
};

/// Makes the cap of one side. pieces: the pieces of this side, into whose edges the cap's points are
/// inserted. Whole faces that get such points become pieces (class bit replaced in cut). If no contour is
/// open, the kept faces, pieces and cap together have no boundary in the plane.
[[nodiscard]] Cap make_cap(PlaneCut& cut, int side, Pieces& pieces);

} // namespace facetmill
