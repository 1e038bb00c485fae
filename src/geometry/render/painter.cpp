#include "geometry/render/painter.hpp"

#include "geometry/render/colour_scale.hpp"

namespace facetmill {

namespace {

const Attribute* colours_of(const Mesh& mesh) {
    for (const Attribute& a : mesh.attributes)
        if (a.role == Role::colour && a.components >= 3) return &a;
    return nullptr;
}

/// The colour of a material without textures: its own base colour if it has a look, otherwise multiplied by
/// grey.
Texel factor_of(const Material& material, const MaterialLook* look) {
    if (look) return look->base;
    Texel colour{};
    for (std::size_t c = 0; c < 4; ++c)
        colour[c] = static_cast<float>(std::clamp(material.base_colour[c], 0.0, 1.0));
    for (std::size_t c = 0; c < 3; ++c) colour[c] *= plain_grey[c];
    return colour;
}

/// White on unshaded elements means that glTF gives no colour.
bool is_white(const Material& material, const MaterialLook* look) {
    for (std::size_t c = 0; c < 3; ++c)
        if ((look ? static_cast<double>(look->base[c]) : material.base_colour[c]) < 1) return false;
    return true;
}

} // namespace

Painter::Painter(const Mesh& mesh, const Scene& scene, const PictureSettings& settings, std::size_t number,
                 const ValueRange& range)
    : mesh_(mesh), range_(range), primitives_(std::max<std::size_t>(1, mesh.primitives.size())) {
    if (const Attribute* a = mesh.find(primitive_attribute, Domain::face))
        primitive_of_face_ = std::get_if<std::vector<std::uint32_t>>(&a->data);
    if (!settings.attribute.empty()) values_ = attribute_to_show(mesh, settings.attribute);
    const bool as_is = settings.paint == Paint::material && settings.attribute.empty();
    if (as_is) colours_ = colours_of(mesh);
    by_normal_ = settings.paint == Paint::normal && !values_;
    const Colour plain = settings.paint == Paint::part ? distinct_colour(number)
                         : colours_                    ? Colour{1, 1, 1}
                                                       : plain_grey;
    const ResolvedMaterials* materials = as_is ? settings.materials.get() : nullptr;
    for (std::size_t i = 0; i < primitives_.size(); ++i) {
        PrimitivePaint& paint = primitives_[i];
        paint.colour = {plain[0], plain[1], plain[2], 1};
        const bool loose = mesh.face_count() == 0 && !colours_ && settings.paint != Paint::part;
        if (loose) paint.colour = loose_colour;
        paint.coloured = colours_ && (i >= mesh.primitives.size() || mesh.primitives[i].has(colours_->name));
        if (i >= mesh.primitives.size() || mesh.primitives[i].material >= scene.materials.size()) continue;
        const Index m = mesh.primitives[i].material;
        paint.double_sided = scene.materials[m].double_sided;
        if (!as_is) continue;
        if (materials && m < materials->size()) paint.look = &(*materials)[m];
        if (!loose || !is_white(scene.materials[m], paint.look))
            paint.colour = factor_of(scene.materials[m], paint.look);
    }
}

bool Painter::any_blends() const {
    return std::any_of(primitives_.begin(), primitives_.end(), [](const PrimitivePaint& paint) {
        return paint.look && paint.look->alpha == MaterialLook::Alpha::blend;
    });
}

Texel Painter::of_value(const FacePlace& place) const {
    const Vec3& w = place.weights;
    const std::size_t nearest = w.x >= w.y && w.x >= w.z ? 0 : w.y >= w.z ? 1 : 2;
    if (element_at(*values_, mesh_, place, nearest) == none)
        return {plain_grey[0], plain_grey[1], plain_grey[2], 1};
    const auto value = [&](std::size_t k) {
        return values_->value(element_at(*values_, mesh_, place, k), 0);
    };
    Colour colour{};
    if (values_->role == Role::index) { // identifiers are never mixed
        colour = distinct_colour(static_cast<std::uint64_t>(std::max(0.0, value(nearest))));
    } else {
        double t = 0;
        for (std::size_t k = 0; k < 3; ++k)
            if (w[k] != 0) t += w[k] * in_range(value(k), range_);
        colour = on_the_scale_of(range_, t);
    }
    return {colour[0], colour[1], colour[2], 1};
}

Texel Painter::of(const FacePlace& place) const {
    if (values_) return of_value(place);
    const PrimitivePaint& paint = primitive(place.face);
    if (!paint.coloured || element_at(*colours_, mesh_, place, 0) == none) return paint.colour;
    Texel colour = paint.colour;
    const std::array<float, 4> own = mixed<4>(*colours_, mesh_, place);
    for (std::size_t c = 0; c < (colours_->components == 4 ? 4U : 3U); ++c)
        colour[c] *= std::clamp(own[c], 0.0f, 1.0f);
    return colour;
}

} // namespace facetmill
