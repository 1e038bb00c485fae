#include "geometry/render/painter.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// Colours that are told apart, linear; the number of an identifier chooses one.
Colour told_apart(std::uint64_t number) {
    static constexpr std::array<Colour, 10> colours{{{0.15f, 0.33f, 0.72f},
                                                     {0.85f, 0.30f, 0.05f},
                                                     {0.14f, 0.52f, 0.16f},
                                                     {0.70f, 0.08f, 0.10f},
                                                     {0.36f, 0.18f, 0.62f},
                                                     {0.80f, 0.60f, 0.06f},
                                                     {0.05f, 0.55f, 0.60f},
                                                     {0.80f, 0.25f, 0.52f},
                                                     {0.26f, 0.14f, 0.08f},
                                                     {0.45f, 0.62f, 0.20f}}};
    return colours[number % colours.size()];
}

/// From dark blue over green to yellow, for 0 to 1.
Colour on_a_scale(double t) {
    static constexpr std::array<Colour, 5> stops{{{0.06f, 0.02f, 0.22f},
                                                  {0.05f, 0.12f, 0.40f},
                                                  {0.03f, 0.30f, 0.30f},
                                                  {0.20f, 0.60f, 0.15f},
                                                  {0.95f, 0.80f, 0.08f}}};
    if (!(t >= 0 && t <= 1)) return {0.5f, 0.5f, 0.5f}; // not a number
    const double at = t * (stops.size() - 1);
    const auto low = std::min(static_cast<std::size_t>(at), stops.size() - 2);
    const auto part = static_cast<float>(at - static_cast<double>(low));
    Colour mixed{};
    for (std::size_t c = 0; c < 3; ++c) mixed[c] = (1 - part) * stops[low][c] + part * stops[low + 1][c];
    return mixed;
}

const Attribute* named(const Mesh& mesh, const std::string& name) {
    for (const Domain domain : {Domain::face, Domain::wedge, Domain::vertex})
        if (const Attribute* a = mesh.find(name, domain); a && a->components > 0) return a;
    return nullptr;
}

const Attribute* colours_of(const Mesh& mesh) {
    for (const Attribute& a : mesh.attributes)
        if (a.role == Role::colour && a.components >= 3) return &a;
    return nullptr;
}

/// The attribute's element for the wedge as a corner of the face, or none when it has none.
Index element(const Attribute& a, const Mesh& mesh, Index face, Index wedge) {
    if (a.domain == Domain::face) return face;
    return a.domain == Domain::wedge ? wedge : mesh.vertex_of_wedge(wedge);
}

} // namespace

std::optional<std::array<double, 2>> range_of(const Scene& scene, const PictureSettings& settings,
                                              bool& found) {
    std::array<double, 2> range{HUGE_VAL, -HUGE_VAL};
    for (const Part& part : scene.parts) {
        if (settings.attribute.empty() || (settings.shows && !settings.shows(part))) continue;
        const Attribute* a = named(part.mesh, settings.attribute);
        found = found || a;
        if (!a || a->role == Role::index) continue;
        for (std::size_t i = 0; i < a->size(); ++i)
            if (const double x = a->value(i, 0); std::isfinite(x))
                range = {std::min(range[0], x), std::max(range[1], x)};
    }
    if (range[0] > range[1]) return std::nullopt;
    return range;
}

Painter::Painter(const Mesh& mesh, const Scene& scene, const PictureSettings& settings, std::size_t number,
                 const std::array<double, 2>& range)
    : mesh_(mesh), range_(range), looks_(std::max<std::size_t>(1, mesh.primitives.size())) {
    if (!settings.attribute.empty()) values_ = named(mesh, settings.attribute);
    const bool as_is = settings.paint == Paint::material && settings.attribute.empty();
    if (as_is) colours_ = colours_of(mesh);
    by_normal_ = settings.paint == Paint::normal && !values_;
    for (std::size_t i = 0; i < looks_.size(); ++i) {
        looks_[i].colour = settings.paint == Paint::part ? told_apart(number) : plain_grey;
        if (i >= mesh.primitives.size() || mesh.primitives[i].material >= scene.materials.size()) continue;
        const Material& material = scene.materials[mesh.primitives[i].material];
        looks_[i].double_sided = material.double_sided;
        if (!as_is) continue;
        for (std::size_t c = 0; c < 3; ++c)
            looks_[i].colour[c] *= static_cast<float>(std::clamp(material.base_colour[c], 0.0, 1.0));
    }
}

const Painter::Look& Painter::look(Index face) const {
    if (face == none) return looks_.front();
    return looks_[std::min<std::size_t>(mesh_.primitive_of(face), looks_.size() - 1)];
}

Colour Painter::of(Index face, Index wedge) const {
    if (values_) {
        const Index i = element(*values_, mesh_, face, wedge);
        if (i == none) return plain_grey;
        const double x = values_->value(i, 0);
        if (values_->role == Role::index) return told_apart(static_cast<std::uint64_t>(std::max(0.0, x)));
        const double span = range_[1] - range_[0];
        return on_a_scale(span > 0 ? (x - range_[0]) / span : 0.5);
    }
    Colour colour = look(face).colour;
    if (!colours_) return colour;
    if (const Index i = element(*colours_, mesh_, face, wedge); i != none)
        for (std::size_t c = 0; c < 3; ++c)
            colour[c] *= static_cast<float>(std::clamp(colours_->value(i, static_cast<int>(c)), 0.0, 1.0));
    return colour;
}

} // namespace facetmill
