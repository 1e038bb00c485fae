#include "geometry/render/colour_range.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill {

namespace {

/// The value that a hundredth times `percent` of the others are below, between neighbours (nearest rank).
double percentile_of(std::vector<double>& values, std::size_t percent) {
    const std::size_t rank = (values.size() - 1) * percent / 100;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

std::vector<double> finite_values(const Scene& scene, const std::string& attribute,
                                  const std::function<bool(const Part&)>& shows) {
    std::vector<double> values;
    for (const Part& part : scene.parts) {
        if (shows && !shows(part)) continue;
        const Attribute* a = attribute_to_show(part.mesh, attribute);
        if (!a || a->role == Role::index) continue;
        values.reserve(values.size() + a->size());
        for (std::size_t i = 0; i < a->size(); ++i)
            if (const double x = a->value(i, 0); std::isfinite(x)) values.push_back(x);
    }
    return values;
}

} // namespace

const Attribute* attribute_to_show(const Mesh& mesh, const std::string& name) {
    for (const Domain domain : {Domain::face, Domain::wedge, Domain::vertex})
        if (const Attribute* a = mesh.find(name, domain); a && a->components > 0) return a;
    return nullptr;
}

ValueRange value_range(const Scene& scene, const std::string& attribute, const ColourRange& wanted,
                       const std::function<bool(const Part&)>& shows) {
    using Kind = ColourRange::Kind;
    ValueRange range;
    std::vector<double> values = finite_values(scene, attribute, shows);
    if (values.empty()) return range;
    range.known = true;
    range.diverging = wanted.diverging;
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    range.min = range.low = *least;
    range.max = range.high = *most;
    if (wanted.kind == Kind::given) {
        range.low = wanted.min;
        range.high = wanted.max;
    }
    if (wanted.kind != Kind::automatic && wanted.kind != Kind::percentile) return range;
    const double low = percentile_of(values, 1), high = percentile_of(values, 99);
    // Halves, because the span of all doubles is none.
    const bool outliers = high / 2 - low / 2 < (range.max / 2 - range.min / 2) / 4;
    if (low < high && (wanted.kind == Kind::percentile || outliers)) {
        range.low = low;
        range.high = high;
        range.percentiles = true;
    }
    return range;
}

} // namespace facetmill
