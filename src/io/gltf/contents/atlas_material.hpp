#pragma once
// Materials as textures: {atlas: true} merges them.

#include "geometry/render/texture.hpp"
#include "mesh/scene.hpp"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace facetmill::io {

struct AtlasTexture {
    std::size_t image = 0;                          ///< its number in the document
    Texture sampling;                               ///< without the image
    std::pair<std::size_t, std::size_t> size{0, 0}; ///< of the image; set by the user of this struct
};

/// A material of a glTF document with the core's textures and factors.
struct AtlasMaterial {
    /// A JSON object with everything else: alpha mode, extensions, extras. Equal for materials that can be
    /// merged.
    std::string kind = "{}";
    std::string apart; ///< the reason why it cannot be merged; otherwise empty
    std::optional<AtlasTexture> base, normal, rough, occlusion, emission;
    std::array<double, 4> colour{1, 1, 1, 1};
    std::array<double, 3> emissive{0, 0, 0}; ///< with the strength of KHR_materials_emissive_strength
    double metalness = 1, roughness = 1, normal_scale = 1, occlusion_strength = 1;

    /// All textures, present or not.
    std::array<const std::optional<AtlasTexture>*, 5> textures() const {
        return {&base, &normal, &rough, &occlusion, &emission};
    }
    /// The texture whose coordinates and filter all its textures share; null without textures.
    const AtlasTexture* any() const {
        for (const auto* one : textures())
            if (*one) return &**one;
        return nullptr;
    }
};

/// The materials of a document. Broken, animated and unsupported ones have the reason in `apart`.
[[nodiscard]] std::vector<AtlasMaterial> atlas_materials(const Document& document);

} // namespace facetmill::io
