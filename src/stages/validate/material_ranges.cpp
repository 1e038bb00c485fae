#include "stages/validate/material_ranges.hpp"

#include "geometry/render/srgb.hpp"
#include "io/gltf/contents/resolved_materials.hpp"
#include "mesh/primitives_in_use.hpp"

#include <algorithm>
#include <set>

namespace facetmill::validate_stage {

namespace {

constexpr double least_metal = 0.1, most_metal = 0.9; // between them, no real material is found

std::set<std::size_t> materials_in_use(const Scene& scene) {
    std::set<std::size_t> used;
    for (const Part& part : scene.parts) {
        const auto in_use = primitives_in_use(part.mesh);
        for (std::size_t p = 0; p < part.mesh.primitives.size() && p < in_use.size(); ++p)
            if (in_use[p] && part.mesh.primitives[p].material < scene.materials.size())
                used.insert(part.mesh.primitives[p].material);
    }
    return used;
}

/// The full-size pixels; null without a texture.
const TextureImage::Level* pixels_of(const Texture& texture) {
    return texture.image && !texture.image->levels.empty() ? &texture.image->levels.front() : nullptr;
}

void add_colours(const MaterialLook& look, MaterialRange& range) {
    const auto add = [&](double value) {
        range.darkest = std::min(range.darkest, value);
        range.brightest = std::max(range.brightest, value);
    };
    const TextureImage::Level* image = pixels_of(look.base_texture);
    if (!image) return add(srgb_of(std::max({look.base[0], look.base[1], look.base[2]})));
    const bool plain = look.base[0] == 1 && look.base[1] == 1 && look.base[2] == 1;
    for (std::size_t i = 0; i < image->rgba.size(); i += 4) {
        const std::uint8_t* c = &image->rgba[i];
        if (plain) {
            add(std::max({c[0], c[1], c[2]}));
            continue;
        }
        float value = 0;
        for (std::size_t k = 0; k < 3; ++k) value = std::max(value, look.base[k] * linear_of(c[k]));
        add(srgb_of(value));
    }
}

bool is_partly_metal(const MaterialLook& look) {
    const auto between = [](double m) { return m > least_metal && m < most_metal; };
    const TextureImage::Level* image = pixels_of(look.rough_texture);
    if (!image) return between(static_cast<double>(look.metalness));
    std::size_t count = 0;
    for (std::size_t i = 2; i < image->rgba.size(); i += 4)
        count += between(static_cast<double>(look.metalness) * image->rgba[i] / 255);
    return count * 20 > image->rgba.size() / 4;
}

} // namespace

std::vector<MaterialRange> material_ranges(const Scene& scene) {
    std::vector<Diagnostic> ignored; // pictures and stages that need the images report them
    io::MaterialResolver resolver(std::size_t{2} << 30, io::MaterialResolver::Extent::all);
    const auto looks = resolver.materials(scene, ignored);
    std::vector<MaterialRange> all;
    for (const std::size_t m : materials_in_use(scene)) {
        MaterialRange& range = all.emplace_back();
        range.name = scene.materials[m].name;
        add_colours((*looks)[m], range);
        range.partly_metal = scene.materials[m].document >= 0 && is_partly_metal((*looks)[m]);
    }
    return all;
}

} // namespace facetmill::validate_stage
