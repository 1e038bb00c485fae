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

struct CropReport {
    std::size_t rings = 0;
    double footprint_area = 0;
    std::string axis;
    std::size_t cut_faces = 0, cap_faces = 0, open_contours = 0, snapped = 0, faces_before = 0,
                faces_after = 0;
};

/// Crops the parts selected. Warns of open contours (W-CAP-OPEN), of parts
/// that the outline does not meet (W-CROP-ALL) and of which nothing is left (W-CROP-NOTHING).
CropReport crop_parts(Scene& scene, const Footprint& footprint, const PartsToCrop& how, Context& context);

} // namespace facetmill
