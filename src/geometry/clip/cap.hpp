#pragma once
// Caps that close a clipped mesh in the plane of the cut. For clip only.

#include "geometry/cut/cut.hpp"

namespace facetmill {

/// Points that a cap adds to the cut, in the numbering of PlaneCut: where contours cross, and where they run
/// through each other's points.
struct ExtraPoints {
    std::vector<Vec3> points;        ///< [extra vertices]
    Provenance vertices, wedges;     ///< mixes only; wedges stays empty without seams
    std::vector<Index> wedge_vertex; ///< [extra wedges] -> vertex; empty without seams
};

/// A contour of the cut that does not close.
struct OpenEnd {
    std::size_t edges = 0;
    Vec3 at;
};

struct Cap {
    std::vector<Index> corners;  ///< vertices, three by three
    std::vector<Index> vertices; ///< that the corners use, ascending
    std::vector<Index> wedges;   ///< of the walls, at each of vertices
    ExtraPoints extra;
    std::vector<OpenEnd> open;
};

/// The cap of one side. pieces are that side's pieces. Points that the cap puts on their edges are inserted,
/// and whole faces that get such points become pieces (class bit replaced in cut). If no contour is open,
/// the kept faces, pieces and cap together have no boundary in the plane.
[[nodiscard]] Cap make_cap(PlaneCut& cut, int side, Pieces& pieces);

} // namespace facetmill
