#pragma once
// Faces that cross themselves, for stages that cut faces into triangles or along planes.

#include "stage/context.hpp"

namespace facetmill {

/// What became of the faces of a scene that cross themselves.
struct FilledFaces {
    std::size_t overlapping = 0; ///< filled, with triangles that lie over each other
    std::size_t fans = 0;        ///< in no plane, or without area: triangles of them may overlap
};

/// Makes triangles of the planar faces that cross themselves, of the parts that the stage works on, over what
/// they wind around (geometry/triangulate/crossing_faces.hpp). What becomes of attributes there is recorded.
/// Parts without such faces are as they were; so are parts of triangles, which are not looked at.
FilledFaces fill_crossing_faces(Scene& scene, Context& context);

/// Warns (W-FANS) of faces whose triangles may overlap.
void warn_of_fans(const FilledFaces& faces, Context& context);

} // namespace facetmill
