#pragma once
// The lines and single points of a scene.

#include "geometry/preview/preview.hpp"

namespace facetmill {

/// Points in world space with a colour each: the ends of lines, two each, then single ones.
struct LooseParts {
    std::vector<Vec3> points;
    std::vector<float> colours;              ///< [4 * points] linear
    std::size_t first_dot = 0;               ///< of the single ones
    std::size_t all_lines = 0, all_dots = 0; ///< of the scene
};

/// Of the parts without faces; of each kind every n-th, so that there are at most so many. Those that are not
/// finite are left out. The colours of mesh and material, or loose_colour.
[[nodiscard]] LooseParts loose_parts(const Scene& scene, const ResolvedMaterials* materials,
                                     std::size_t most);

/// Appends them to the vertices of the preview.
void append_loose(Preview& preview, const LooseParts& loose);

} // namespace facetmill
