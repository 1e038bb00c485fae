#pragma once
// Crops a mesh to a footprint: a polygon with holes, projected along an axis.

#include "geometry/clip/clip.hpp"
#include "geometry/polygon/footprint.hpp"

namespace facetmill {

enum class CropBy {
    cut,         ///< faces are cut at the outline
    whole,       ///< keeps faces that are completely on the kept side
    centre,      ///< keeps faces whose mean corner is on the kept side
    overlapping, ///< keeps faces with any part on the kept side
};

/// The test for points inside the footprint; all give the same result for points off the outline.
enum class InsideBy {
    crossings,   ///< an odd number of edges to one side; exact, in logarithmic time
    angles,      ///< the angles that the edges subtend sum to 2 pi rather than 0
    half_planes, ///< the point is on the same side of all edges: only for a single convex ring
    angles_3d,   ///< the unsigned angles between the corners sum to 2 pi: only for a single convex ring
};

struct CropSettings {
    std::size_t axis = 2; ///< projection: 2 z (the footprint is in x and y), 1 y (x and z), 0 x (y and z)
    Transform to_world;   ///< from the mesh's space to the footprint's world space
    CropBy by = CropBy::cut;
    polygon::Keep keep = polygon::Keep::inside;
    InsideBy inside_by = InsideBy::crossings;
    bool cap = false; ///< with CropBy::cut: closes the cut with upright walls along the outline
    /// As for clip; cut_id numbers the outline's segments, group its rings.
    std::optional<Primitive> cap_primitive;
    bool cap_numbers = false;
    /// Treats 32-bit floats as on the outline if they may be off it by their rounding alone (CoordinateErrors
    /// in geometry/cut/cut.hpp). It is disabled if a segment is hardly longer than that, or if walls could
    /// not be closed.
    bool snap = false;
    CutMemory memory; ///< points known to be on planes
};

struct CropResult {
    Mesh mesh;
    AttributeChanges changes;
    std::size_t cut_faces = 0;  ///< faces that the outline cut (CropBy::cut)
    std::size_t kept_faces = 0; ///< faces kept without a cut
    std::size_t cap_faces = 0;  ///< faces of the walls
    /// Vertices off a segment's plane by more than rounding that snap treats as on it. Vertices exactly on
    /// another segment are included.
    std::size_t snapped = 0;
    double snapped_by = 0; ///< the largest distance of a snapped vertex from its segment's line, in world
    bool changed = false;
    std::vector<OpenContour> open; ///< contours of open meshes without a wall; plane is the segment
    CutMemory memory;
};

/// A point projected along an axis.
[[nodiscard]] Vec2 seen_along(std::size_t axis, const Vec3& p);

/// Crops a mesh. Cutting: a segment of the outline cuts every face that it enters along the segment's line,
/// across the whole piece. So a face at a corner of the outline gets more pieces than necessary. If a
/// segment enters a piece by no more than rounding, the piece is not cut. Each cut edge gets one point, by
/// the exact signs of side(). The point counts as on the segment's plane. Neighbours get it too, so no crack
/// opens. A point in the middle decides whether a piece is inside. Faces that are edge-on along the outline
/// belong to the side that they face away from. Attributes follow the rules of clip.
///
/// Vertices that no kept face uses are removed, isolated ones too. Points of a cloud on the kept side stay;
/// points on the outline count as inside. Kept faces keep their order, but faces next to the outline come
/// last.
///
/// Caps: a closed mesh stays closed. Walls close the outline and its holes. Both sides get the same wall
/// triangles in opposite orientation, so their volumes add up. In an open mesh, only contours that close get
/// walls (see close_crop).
///
/// Throws a usage error (E-FOOTPRINT) when inside_by needs a convex ring and the footprint has none, and a
/// stage error (E-CROP-CAP) when a closed mesh cannot be closed. The inside tests follow P. Bourke,
/// "Determining if a point lies on the interior of a polygon" (1987).
[[nodiscard]] CropResult crop(const Mesh& mesh, const Footprint& footprint, const CropSettings& settings);

/// Returns the inside and the outside; ignores settings.keep. Their walls match even if snap must be
/// disabled to close one of them.
[[nodiscard]] std::vector<CropResult> crop_both(const Mesh& mesh, const Footprint& footprint,
                                                const CropSettings& settings);

} // namespace facetmill
