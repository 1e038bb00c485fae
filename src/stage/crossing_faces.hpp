#pragma once
// Self-intersecting faces, for stages that triangulate faces or cut them along planes.

#include "mesh/scene.hpp"

namespace facetmill {

class Context;

/// How to handle self-intersecting faces before a stage runs.
enum class CrossingFacePolicy {
    keep, ///< no change; the stage only uses edges and corners, or tolerates such faces
    name, ///< warns about non-planar faces; the stage uses the area that faces cover (filled_surface)
    fill, ///< triangulates planar faces and warns about others; the stage cuts faces or moves single vertices
};

/// Prepares the selected parts. fill triangulates the area that a planar self-intersecting face winds around
/// (geometry/triangulate/crossing_faces.hpp), and records the changes to attributes. Parts without such faces
/// stay unchanged. Warns like warn_of_fans.
void prepare_crossing_faces(CrossingFacePolicy policy, Scene& scene, Context& context);

/// Warns (W-FANS) about non-planar self-intersecting faces of the selected parts.
void name_fans(const Scene& scene, Context& context);

/// Faces whose triangles may overlap.
struct FanCounts {
    std::size_t fans = 0;        ///< non-planar, or without area
    std::size_t overlapping = 0; ///< filled with overlapping triangles
};

/// Warns (W-FANS) if the counts are not 0.
void warn_of_fans(const FanCounts& faces, Context& context);

} // namespace facetmill
