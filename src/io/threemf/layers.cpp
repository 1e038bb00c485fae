#include "io/threemf/layers.hpp"

#include "geometry/render/srgb.hpp"
#include "io/text.hpp"

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

} // namespace

Group blended(const Layers& layers, const std::map<std::uint32_t, Group>& groups, const std::string& name) {
    Group all;
    all.colours.reserve(layers.multis.size());
    for (const std::vector<std::uint32_t>& multi : layers.multis) {
        Blend blend;
        for (std::size_t l = 0; l < layers.groups.size(); ++l) {
            const auto group = groups.find(layers.groups[l]);
            if (group == groups.end()) continue;
            const std::size_t index = l < multi.size() ? multi[l] : 0;
            if (index >= group->second.colours.size())
                malformed(name, 0, "E-3MF",
                          fmt::format("multiproperties name property {} of group {}, which has {}", index,
                                      group->first, group->second.colours.size()));
            blend.add(group->second.colours[index],
                      l > 0 && l - 1 < layers.multiply.size() && layers.multiply[l - 1]);
        }
        all.colours.push_back(blend.colour());
    }
    return all;
}

} // namespace facetmill::io::threemf
