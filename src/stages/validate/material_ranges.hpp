#pragma once
// The ranges of the colours and the metalness of materials.

#include "mesh/scene.hpp"

#include <string>
#include <vector>

namespace facetmill::validate_stage {

struct MaterialRange {
    std::string name;
    double darkest = 255, brightest = 0; ///< the largest channel of base colours, in sRGB, from 0 to 255
    bool partly_metal = false;           ///< neither metal nor non-metal
};

/// The materials that faces use. Decodes their images; broken images count as absent.
[[nodiscard]] std::vector<MaterialRange> material_ranges(const Scene& scene);

} // namespace facetmill::validate_stage
