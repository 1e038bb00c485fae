#pragma once
// Crops a mesh to a footprint: a polygon with holes, seen along an axis.

#include "geometry/cut_memory.hpp"
#include "geometry/footprint.hpp"
#include "mesh/lineage.hpp"

namespace facetmill {

enum class CropBy {
    cut,      ///< faces are cut at the outline
    whole,    ///< faces that lie wholly on the kept side stay
    centre,   ///< faces whose corners' mean lies there
    touching, ///< faces of which any part lies there
};

/// How it is found whether a point is inside; all agree, off the outline.
enum class InsideBy {
    crossings,   ///< an odd number of edges to one side; exact, in logarithmic time
    angles,      ///< the angles that the edges subtend sum to 2 pi rather than 0
    half_planes, ///< on one side of all edges: one convex ring only
    angles_3d,   ///< the unsigned angles between the corners sum to 2 pi: one convex ring only
};

struct CropSettings {
    std::size_t axis = 2; ///< looked along: 2 z (the footprint is in x and y), 1 y (x and z), 0 x (y and z)
    Transform to_world;   ///< the footprint stands in the world
    CropBy by = CropBy::cut;
    polygon::Keep keep = polygon::Keep::inside;
    InsideBy inside_by = InsideBy::crossings;
    CutMemory memory; ///< points known to be on planes
};

struct CropResult {
    Mesh mesh;
    Fates fates;
    std::size_t cut_faces = 0;  ///< faces that the outline passed through (CropBy::cut)
    std::size_t kept_faces = 0; ///< whole
    bool changed = false;
    CutMemory memory;
};

/// A point seen along an axis.
Vec2 seen_along(std::size_t axis, const Vec3& p);

/// Cutting: every face that a segment of the outline enters is cut along the segment's line, all across the
/// face, so that a face at a corner falls into more pieces than it must. Points are made once per edge, by
/// the exact signs of side(), and those of a segment are remembered to be on its plane; neighbours get them
/// too, so no crack opens. Each piece is then inside or outside by a point in its middle, faces seen edge-on
/// along the outline by the side that they look to. What is cut open is not capped. Attributes as for clip.
/// Vertices that no kept face uses go, isolated ones too. Kept faces come in their order, those beside the
/// outline last. Throws usage (E-FOOTPRINT) when inside_by needs a convex ring and there is none such.
/// Source: "Inside a polygon" (notes, 1987).
CropResult crop(const Mesh& mesh, const Footprint& footprint, const CropSettings& settings);

} // namespace facetmill
