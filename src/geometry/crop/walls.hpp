#pragma once
// Walls that close the cuts of a crop. Only crop uses it.

#include "base/error.hpp"
#include "geometry/clip/clip.hpp"
#include "geometry/polygon/footprint.hpp"

namespace facetmill {

/// Thrown if a cut cannot be closed (E-CROP-CAP).
struct UnclosedWalls : Error {
    using Error::Error;
};

struct WallSettings {
    std::size_t axis = 2; ///< as CropSettings::axis
    Transform to_world;
    std::optional<Primitive> primitive; ///< the primitive of the walls
    /// The largest numbers in the face attributes cut_id and group. Walls get the next numbers, by segment
    /// and by ring. Empty: these attributes are not made.
    std::optional<Index> last_cut, last_group;
    double reach = 0;   ///< the largest world coordinate across the axis before the cut
    bool closed = true; ///< the mesh was closed before the cut: its whole boundary must be closed
};

struct WalledCrop {
    Mesh mesh;
    AttributeChanges changes;
    std::size_t wall_faces = 0;
    std::vector<OpenContour> open; ///< contours that are not closed; plane is the segment
    /// Points that were made for the walls, with the segment of each.
    std::vector<std::pair<Index, Vec3>> made;
};

/// Closes the kept faces of a mesh that was cut along the footprint. Each edge of their boundary is assigned
/// to the nearest segment. If the boundary passes from one segment to the next, upright edges at the corner
/// of the outline close the boundary on both segments. Each wall is filled like the caps of clip
/// (fill_disjoint), so an area covered twice gets two walls. The result is closed by edge counts, not only by
/// positions. Points that the filling needs on edges are inserted into the kept faces too, so a triangle may
/// become several. Reversed edges give the same triangles in opposite orientation, except triangles without
/// area between points at the same position.
///
/// Walls get attributes like caps of clip. In an open mesh, only edges on the outline count; contours that
/// do not close are left open and reported. Throws UnclosedWalls if a closed mesh's walls cannot be
/// completed.
[[nodiscard]] WalledCrop close_crop(Mesh kept, const Footprint& footprint, const WallSettings& settings);

} // namespace facetmill
