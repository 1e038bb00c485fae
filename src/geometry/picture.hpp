#pragma once
// A picture of a scene, for people who would rather look: orthographic, from the front, somewhat from above
// and from the right, shaded by the direction of the faces.

#include "mesh/scene.hpp"

namespace facetmill {

struct PictureSettings {
    int width = 480, height = 360; ///< pixels
    /// Triangle meshes of at most so many faces show their edges.
    std::size_t edges_up_to = 6000;
};

/// Rows from the top, four bytes a pixel: red, green, blue (sRGB), alpha (0 where nothing is).
struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
};

/// The scene in world space, as large as fits. Up is the scene's, or else the longer one of y and z. Faces
/// have the base colour of their material; their inner sides are orange unless the material is double-sided,
/// so that holes and turned faces are seen. Scenes without faces show their vertices. Points that are not
/// finite are left out, and an empty scene gives an empty picture. Each pixel has four samples. The same for
/// any number of threads.
Picture picture_of(const Scene& scene, const PictureSettings& settings = {});

} // namespace facetmill
