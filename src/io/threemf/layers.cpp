#include "io/threemf/layers.hpp"

#include "geometry/render/srgb.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::io::threemf {

namespace {

/// Linear light and alpha of the layers so far.
struct Blend {
    std::array<double, 3> light{1, 1, 1};
    double alpha = 1;
    bool empty = true;

    void add(const Colour& top, bool multiply) {
        const double own = top[3] / 255.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double x = linear_of(top.at(c));
            if (empty)
                light.at(c) = x;
            else if (multiply)
                light.at(c) *= x;
            else
                light.at(c) += own * (x - light.at(c));
        }
        alpha = empty ? own : multiply ? alpha * own : alpha + own * (1 - alpha);
        empty = false;
    }
    Colour colour() const {
        Colour c;
        for (std::size_t i = 0; i < 3; ++i) c.at(i) = srgb_of(static_cast<float>(light.at(i)));
        c[3] = static_cast<std::uint8_t>(std::lround(255 * alpha));
        return c;
    }
};

/// A layer whose group is known.
struct KnownLayer {
    const Group* group;
    std::size_t number; ///< among all layers
    bool multiply;      ///< otherwise mixed by alpha with the layers below
};

std::vector<KnownLayer> known_layers(const Layers& layers, const Model& model) {
    std::vector<KnownLayer> known;
    for (std::size_t l = 0; l < layers.groups.size(); ++l)
        if (const auto group = model.groups.find(layers.groups[l]); group != model.groups.end())
            known.push_back(
                {&group->second, l, l > 0 && l - 1 < layers.multiply.size() && layers.multiply[l - 1]});
    return known;
}

/// The layers that are seen, from the lowest. Only the last texture can stay, and only if the layers above
/// multiply it.
std::vector<KnownLayer> seen_layers(const std::vector<KnownLayer>& known) {
    const auto is_texture = [](const KnownLayer& layer) { return layer.group->textured(); };
    const auto top = std::find_if(known.rbegin(), known.rend(), is_texture).base();
    const bool stays = top != known.begin() &&
                       std::all_of(top, known.end(), [](const KnownLayer& layer) { return layer.multiply; });
    std::vector<KnownLayer> seen;
    for (auto at = known.begin(); at != known.end(); ++at) {
        const bool hidden = stays && at + 1 < top && !(top - 1)->multiply;
        if (!hidden && (!is_texture(*at) || (stays && at + 1 == top))) seen.push_back(*at);
    }
    return seen;
}

} // namespace

Group blended(const Layers& layers, Model& model) {
    const std::vector<KnownLayer> known = known_layers(layers, model), seen = seen_layers(known);
    if (seen.size() < known.size()) ++model.skipped["layers beside a texture"];
    Group all;
    for (const KnownLayer& layer : seen)
        if (layer.group->textured()) all.texture = layer.group->texture;
    all.colours.reserve(layers.multis.size());
    std::set<std::pair<std::uint32_t, std::size_t>> beyond;
    for (const std::vector<std::uint32_t>& multi : layers.multis) {
        Blend blend;
        for (const KnownLayer& layer : seen) {
            const std::size_t index = layer.number < multi.size() ? multi[layer.number] : 0;
            const bool known = index < layer.group->size();
            if (!known) beyond.insert({layers.groups[layer.number], index});
            if (layer.group->textured())
                all.points.push_back(known ? layer.group->points[index] : std::array<float, 2>{});
            else if (known)
                blend.add(layer.group->colours[index], layer.multiply);
        }
        if (!all.textured() || seen.size() > 1) all.colours.push_back(blend.colour());
    }
    for (const auto& [group, index] : beyond)
        model.faults.push_back(
            fmt::format("line {}: multiproperties name property {} of group {}, which has {}: "
                        "the layer is left out there",
                        layers.line, index, group, model.groups.at(group).size()));
    return all;
}

} // namespace facetmill::io::threemf
