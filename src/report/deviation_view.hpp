#pragma once
// Distances of a scene from an earlier scene, as pages show them: numbers, a histogram, coloured pictures.

#include "geometry/render/render.hpp"
#include "geometry/spatial/face_tree.hpp"
#include "report/views.hpp"

namespace facetmill::report {

/// The reference surface of distances.
struct EarlierSurface {
    std::string name; ///< "the scene as loaded"
    double diagonal = 0;
    const FaceTree& tree;
    std::optional<Index> last_cap = {}; ///< see SignedDeviationSettings::last_cap
};

/// Half the width of the colour scale for distances. It covers all distances; if at most a tenth of them are
/// far off, only the rest, for better contrast. It is at least the rounding error of float32 positions.
/// Distances beyond it have the colour of the end. most: the largest absolute distance. diagonal: the
/// scene's diagonal.
[[nodiscard]] double colour_limit(const std::vector<float>& distances, double most, double diagonal);

/// A tree over an earlier surface for the about 100,000 distances of a page. bounds: the box of the surface,
/// which must outlive the tree.
[[nodiscard]] FaceTree tree_of_earlier(const Surface& surface, const Box& bounds);

/// Measures the deviation; both must be in world space and in the same pose. pictures: their size and
/// camera; empty: only numbers. Throws the errors of picture_of. O((vertices + faces) log n), for at most
/// 20000 vertices or some tens of thousands of cells, and for cells around the worst position.
[[nodiscard]] DeviationView deviation_view(const Scene& scene, const EarlierSurface& from,
                                           const std::optional<PictureSettings>& pictures);

} // namespace facetmill::report
