#pragma once
// Walls that close what a crop cuts open. For crop only.

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
    std::optional<Primitive> primitive; ///< of the walls
    /// Numbers in the face attributes cut_id and group that are taken; walls get the next ones, by segment
    /// and by ring. None: these attributes are not made.
    std::optional<Index> last_cut, last_group;
    double reach = 0; ///< the largest coordinate across the axis of the mesh before it was cut, in the world
    bool closed = true; ///< the mesh was before it was cut: then all its boundary is to be closed
};

struct WalledCrop {
    Mesh mesh;
    AttributeChanges changes;
    std::size_t wall_faces = 0;
    std::vector<OpenContour> open; ///< plane: the segment
    /// Points that were made for the walls, and the segment of each.
    std::vector<std::pair<Index, Vec3>> made;
};

/// Closes the kept faces of a mesh that was cut along the footprint. Each edge of their boundary goes to the
/// segment that it is nearest to; where the boundary passes from one segment to another, upright edges at the
/// corner of the outline complete both, so that the boundary on every segment is closed. It is filled there
/// as clip fills its caps (fill_disjoint), so whatever covers a place twice has its wall twice. So the result
/// is closed, by counting edges and not by their places. Points that the filling needs on edges are put into
/// the kept faces too, so a triangle may become several. The same edges the other way round give the same
/// triangles, turned, but for those without area between points at one place.
///
/// Attributes: walls have their own as caps of clip have. Of a mesh that was open, only edges on the outline
/// count, and contours that do not close are left and reported. Throws UnclosedWalls (stage, E-CROP-CAP) for
/// a closed mesh when the walls cannot be completed.
WalledCrop close_crop(Mesh kept, const Footprint& footprint, const WallSettings& settings);

} // namespace facetmill
