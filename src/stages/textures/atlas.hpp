#pragma once
// Merges textured materials into atlases.

#include "stages/textures/options.hpp"

namespace facetmill::textures_stage {

struct AtlasImage {
    std::string texture; ///< its name in the material
    std::size_t width = 0, height = 0, bytes = 0;
};

struct MadeAtlas {
    std::string material;
    std::vector<std::string> materials, halved; ///< names of the merged materials
    std::size_t width = 0, height = 0;
    double used = 0; ///< share of the texels
    std::vector<AtlasImage> images;
};

struct ApartMaterial {
    std::string material, reason;
};

struct AtlasCounts {
    std::size_t draw_calls = 0, materials = 0, images = 0, bytes = 0;
};

struct AtlasesReport {
    std::vector<MadeAtlas> atlases;
    std::vector<ApartMaterial> apart;
    AtlasCounts before, after;
};

/// Gives selected parts with materials of one kind a common material with an atlas of their textures. Other
/// materials stay, with the reason in the report.
[[nodiscard]] AtlasesReport make_atlases(Scene& scene, const TexturesOptions& o, Context& context);

void declare_atlases(DeclareFields<AtlasesReport>& d);
[[nodiscard]] std::vector<std::string> lines_of(const AtlasesReport& report);

} // namespace facetmill::textures_stage
