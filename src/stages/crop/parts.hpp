#pragma once
// Crops the parts of a scene.

#include "geometry/crop/crop.hpp"
#include "stage/context.hpp"

namespace facetmill {

struct PartsToCrop {
    CropSettings
        settings;      ///< the same for all; transform, memory and the caps' primitive are set part by part
    bool both = false; ///< the inside and, behind it as a part of its own, the outside
    std::string cap_material;
};

/// Crops the parts selected. Counts go into the stage's result. Warns of open contours (W-CAP-OPEN), of parts
/// that the outline does not meet (W-CROP-ALL) and of which nothing is left (W-CROP-NOTHING).
void crop_parts(Scene& scene, const Footprint& footprint, const PartsToCrop& how, Context& context);

} // namespace facetmill
