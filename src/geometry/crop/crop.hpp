#pragma once
// Crops a mesh to a footprint: a polygon with holes, seen along an axis.

#include "geometry/clip/clip.hpp"
#include "geometry/polygon/footprint.hpp"

namespace facetmill {

enum class CropBy {
    cut,         ///< faces are cut at the outline
    whole,       ///< faces that lie wholly on the kept side stay
    centre,      ///< faces whose corners' mean lies there
    overlapping, ///< faces of which any part lies there
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
    bool cap = false; ///< with CropBy::cut: close what is cut open by upright walls along the outline
    /// As for clip; cut_id numbers the outline's segments, group its rings.
    std::optional<Primitive> cap_primitive;
    bool cap_numbers = false;
    /// Take float32 positions within one float32 ulp of the mesh's bounds as on the outline, unless a segment
    /// is hardly longer than that or walls could not be closed so.
    bool snap = false;
    CutMemory memory; ///< points known to be on planes
};

struct CropResult {
    Mesh mesh;
    AttributeChanges changes;
    std::size_t cut_faces = 0;  ///< faces that the outline passed through (CropBy::cut)
    std::size_t kept_faces = 0; ///< whole
    std::size_t cap_faces = 0;  ///< of the walls
    /// Vertices beside a segment's plane, by more than rounding, that snap takes as on it; those that are
    /// exactly on another segment are among them.
    std::size_t snapped = 0;
    bool changed = false;
    std::vector<OpenContour> open; ///< contours of open meshes that got no wall; plane is the segment
    CutMemory memory;
};

/// A point seen along an axis.
Vec2 seen_along(std::size_t axis, const Vec3& p);

/// Cutting: every face that a segment of the outline enters is cut along the segment's line, all across the
/// piece that is left of it, so that a face at a corner falls into more pieces than it must; a piece that it
/// enters by no more than the rounding of points is not cut. Points are made once per edge, by
/// the exact signs of side(), and those of a segment are remembered to be on its plane; neighbours get them
/// too, so no crack opens. Each piece is then inside or outside by a point in its middle, faces seen edge-on
/// along the outline by the side that they look to. Attributes as for clip.
/// Vertices that no kept face uses go, isolated ones too; of a mesh without faces, a cloud of points, those
/// on the kept side stay, and those on the outline count as inside. Kept faces come in their order, those
/// beside the outline last. Throws usage (E-FOOTPRINT) when inside_by needs a convex ring and there is none
/// such. Capped, a closed mesh stays closed: walls stand on the outline and on its holes, and those of the
/// inside and of the outside are the same triangles, turned; so the volumes of the two sides add up. Of an
/// open mesh the contours that close get walls (see close_crop). Throws stage (E-CROP-CAP) when a closed mesh
/// cannot be closed. Inside is decided as by P. Bourke, "Determining if a point lies on the interior of a
/// polygon" (1987).
CropResult crop(const Mesh& mesh, const Footprint& footprint, const CropSettings& settings);

/// The inside and the outside, whatever settings.keep is: their walls match also where snap cannot close one
/// of them.
std::vector<CropResult> crop_both(const Mesh& mesh, const Footprint& footprint, const CropSettings& settings);

} // namespace facetmill
