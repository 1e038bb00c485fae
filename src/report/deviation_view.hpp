#pragma once
// Distances of a scene from an earlier one as pages show them: numbers, a histogram, pictures in colours.

#include "geometry/render/render.hpp"
#include "geometry/spatial/face_tree.hpp"
#include "report/views.hpp"

namespace facetmill::report {

/// The reference of distances.
struct EarlierSurface {
    std::string name; ///< "the scene as loaded"
    double diagonal = 0;
    const FaceTree& tree;
    std::optional<Index> last_cap = {}; ///< SignedDeviationSettings::last_cap
};

/// Half the width of the scale of distances: all of it, or, where a tenth or less is far off, what tells the
/// rest apart, and at least what positions in float32 may be off by. What lies beyond has the colour of the
/// end. most: the largest amount. diagonal: of the scene.
double colour_limit(const std::vector<float>& distances, double most, double diagonal);

/// The tree over an earlier surface for the distances of a page, about 100,000. The surface has these bounds
/// and must not change.
FaceTree tree_of_earlier(const Surface& surface, const Box& bounds);

/// Both in world space, and in one pose. pictures: their size and camera; none: only numbers. Throws as
/// picture_of. O((vertices + faces) log n), of at most 20000 vertices or some tens of thousands of cells, and
/// those around the worst place.
DeviationView deviation_view(const Scene& scene, const EarlierSurface& from,
                             const std::optional<PictureSettings>& pictures);

} // namespace facetmill::report
