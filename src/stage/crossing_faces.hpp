#pragma once
// Faces that cross themselves, for stages that cut faces into triangles or along planes.

#include "mesh/scene.hpp"

namespace facetmill {

class Context;

/// What is done about faces that cross themselves before a stage runs.
enum class CrossingFacePolicy {
    keep, ///< nothing: only their edges and corners matter to it, or it does without
    name, ///< those that cross themselves in no plane are named: it goes by what faces cover (filled_surface)
    fill, ///< planar ones become triangles, the others are named: it cuts faces, or moves single vertices
};

/// Of the parts that the stage works on. fill makes triangles of planar faces that cross themselves, over
/// what they wind around (geometry/triangulate/crossing_faces.hpp), and records what becomes of attributes
/// there; parts without such faces are as they were. Warns as warn_of_fans.
void prepare_crossing_faces(CrossingFacePolicy policy, Scene& scene, Context& context);

/// Warns (W-FANS) of the faces that cross themselves in no plane, of the parts that the stage works on.
void name_fans(const Scene& scene, Context& context);

/// Faces whose triangles may overlap.
struct FanCounts {
    std::size_t fans = 0;        ///< in no plane, or without area
    std::size_t overlapping = 0; ///< filled, with triangles that lie over each other
};

/// Warns (W-FANS) when there are any.
void warn_of_fans(const FanCounts& faces, Context& context);

} // namespace facetmill
