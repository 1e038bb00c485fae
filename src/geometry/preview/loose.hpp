#pragma once
// The lines and single points of a scene.

#include "geometry/preview/preview.hpp"

namespace facetmill {

/// Points in world space, each with a colour: the two ends of each line, then single points.
struct LooseParts {
    std::vector<Vec3> points;
    std::vector<float> colours;              ///< [4 * points] linear colours
    std::size_t first_dot = 0;               ///< index of the first single point
    std::size_t all_lines = 0, all_dots = 0; ///< counts in the scene
};

/// Collects lines and points of the parts without faces, every n-th of each kind to stay within the limit.
/// Skips points that are not finite. Colours come from the mesh and material, otherwise loose_colour.
[[nodiscard]] LooseParts loose_parts(const Scene& scene, const ResolvedMaterials* materials,
                                     std::size_t most);

/// Appends lines and points to the vertices of the preview.
void append_loose(Preview& preview, const LooseParts& loose);

} // namespace facetmill
