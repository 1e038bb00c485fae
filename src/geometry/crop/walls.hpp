#pragma once
// Walls that close the cuts of a crop. Only crop uses it.

#include "base/error.hpp"
#include "geometry/clip/clip.hpp"
#include "geometry/polygon/footprint.hpp"

namespace facetmill {

/// A cut that cannot be closed (E-CROP-CAP).
struct UnclosedWalls : Error {
    using Error::Error;
};

struct WallSettings {
    std::size_t axis = 2; ///< as CropSettings::axis
    Transform to_world;
    std::optional<Primitive> primitive; ///< for the walls
    /// The last used numbers in the face attributes cut_id and group; walls get the next numbers, by segment
    /// and by ring. Empty: these attributes are not made.
    std::optional<Index> last_cut, last_group;
    double reach = 0;   ///< the largest world coordinate across the axis before the cut
    bool closed = true; ///< the mesh was closed before the cut: its whole boundary must be closed
};

struct WalledCrop {
    Mesh mesh;
    AttributeChanges changes;
    std::size_t wall_faces = 0;
    std::vector<OpenContour> open; ///< plane: the segment
    /// Points that were made for the walls, with the segment of each.
    std::vector<std::pair<Index, Vec3>> made;
};

/// Closes the kept faces of a mesh that was cut along the footprint. Each edge of their boundary is assigned
/// to the nearest segment. Where the boundary changes segments, upright edges at the corner of the outline
/// complete both, so that the boundary on every segment is closed. Each wall is filled as clip fills its caps
/// (fill_disjoint), so an area covered twice gets two walls. So the result is closed, by edge counts and not
/// by positions. Points that the filling needs on edges are inserted into the kept faces too, so a triangle
/// may become several. Reversed edges give the same triangles in opposite orientation, except triangles
/// without area between points at the same position.
///
/// Attributes: walls have their own, like caps of clip. In a mesh that was open, only edges on the outline
/// count; contours that do not close are left open and reported. Throws UnclosedWalls (stage, E-CROP-CAP) if
/// a closed mesh's walls cannot be completed.
[[nodiscard]] WalledCrop close_crop(Mesh kept, const Footprint& footprint, const WallSettings& settings);

} // namespace facetmill
