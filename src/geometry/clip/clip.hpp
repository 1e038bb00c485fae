#pragma once
// Clips a mesh by planes, with caps.

#include "mesh/cut_memory.hpp"
#include "mesh/provenance.hpp"

namespace facetmill {

enum class Keep {
    front, ///< in the direction of the plane's normal
    back,  ///< the other side
    both,  ///< both sides, as separate meshes
};

/// The treatment of faces with all vertices in the plane, for open meshes.
enum class Coplanar { keep, drop };

struct ClipSettings {
    std::vector<Plane> planes; ///< planes in the mesh's own space, applied in order
    Keep keep = Keep::front;   ///< `both` needs a single plane, or a convex body
    /// The planes bound a convex body and face into it. The back is then the outside of the body, not the
    /// back of each plane.
    bool convex = false;
    bool cap = false;         ///< closes the openings of the cut
    bool triangulate = false; ///< triangulates all faces, including faces that were not cut
    Coplanar coplanar = Coplanar::keep;
    /// The primitive of cap faces, appended to the mesh's primitives unless an equal one exists. Empty:
    /// primitive 0.
    std::optional<Primitive> cap_primitive;
    /// Numbers cap faces, plane by plane, in the face attributes cut_id (0: no cap) and group. Both continue
    /// after the largest existing number.
    bool cap_numbers = false;
    /// Positions count as on the plane if rounding alone may have moved them off it (CoordinateErrors in
    /// geometry/cut/cut.hpp).
    bool snap = false;
    CutMemory memory = {}; ///< points known to be on planes
};

/// A contour of the cut that could not be capped, because it does not close.
struct OpenContour {
    std::size_t plane = 0; ///< the index of the plane
    std::size_t edges = 0; ///< the number of its edges
    Vec3 at;               ///< one of its ends, in the mesh's own space
};

struct ClipResult {
    Mesh front, back; ///< the kept parts; a side that was not requested stays empty
    AttributeChanges changes;
    std::size_t cut_faces = 0;               ///< faces that a plane passed through
    std::size_t on_plane = 0;                ///< vertices that count as on a plane
    std::size_t snapped = 0, remembered = 0; ///< vertices on the plane because of snap, and because of memory
    double snapped_by = 0;                   ///< the largest distance of a snapped vertex from its plane
    std::size_t cap_faces = 0;
    bool changed = false;          ///< false: no plane met the mesh and all of it was kept
    std::vector<OpenContour> open; ///< contours that were not capped; empty unless `cap`
    CutMemory memory;              ///< the updated memory
};

/// Every vertex is classified once per plane, by the exact sign of side(plane, p), so neighbours always
/// agree. Points built on a plane count as on it when the plane recurs (see CutMemory), so that repeated and
/// adjoining cuts meet without slivers. A face with vertices strictly on both sides is cut directly, whether
/// triangle, quad or n-gon (convex or not). Each cut edge gets one new vertex, shared by all faces at it, and
/// one new wedge per pair of wedges, computed with the edge's ends in index order. For an axis-aligned plane,
/// the vertex's coordinate is exactly the plane's. A face that only touches the plane stays or goes whole. A
/// face in the plane of a closed mesh (and with Keep::both) stays on the side that its normal points away
/// from; for an open mesh settings.coplanar decides. Caps: for a closed mesh, the edges in the plane at which
/// the directions of the kept faces do not cancel are closed contours. They are projected along the normal's
/// dominant axis and filled by a constrained Delaunay triangulation that emits each triangle as often as the
/// contours turn around it. So islands and holes nest, and contours that cross still close. Vertices and
/// edges of faces that only touch the plane become corners and edges of the cap, so faces end in none of its
/// triangles. Points where contours cross are also inserted into the wall faces. Therefore every closed mesh
/// stays closed. A capped manifold mesh stays manifold, unless it intersects itself in the plane: if solids
/// touch in the plane, each gets its own vertices. Open contours are reported and left open. Attributes: kept
/// elements keep their attributes; new vertices and wedges are interpolated; pieces copy their face's. Cap
/// faces have zeros in face attributes other than "primitive". When the mesh has NORMAL or TEXCOORD_0, caps
/// get their own wedges with the plane's normal and planar coordinates (the cap's larger extent is 1), the
/// rest interpolated as on the walls. Vertices that no kept face uses are removed, unless they are isolated
/// on the kept side. Order: kept faces and pieces in the order of their faces, followed by the cap. Throws
/// usage (E-PLANE) for an invalid plane, and for Keep::both with several planes without `convex`. After P.
/// Bourke, "Clipping Polygonal Facets with an Arbitrary Plane" (1997).
[[nodiscard]] ClipResult clip(Mesh mesh, const ClipSettings& settings);

} // namespace facetmill
