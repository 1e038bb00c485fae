#include "geometry/render/colour_range.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace facetmill {

namespace {

/// The percentile, by the nearest-rank method.
double percentile_of(std::vector<double>& values, std::size_t percent) {
    const std::size_t rank = (values.size() - 1) * percent / 100;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

std::vector<double> finite_values(const Scene& scene, const std::string& attribute,
                                  const std::function<bool(const Part&)>& shows, std::size_t& missing) {
    std::vector<double> values;
    for (const Part& part : scene.parts) {
        if (shows && !shows(part)) continue;
        const Attribute* a = attribute_to_show(part.mesh, attribute);
        if (!a || a->role == Role::index) continue;
        values.reserve(values.size() + a->size());
        for (std::size_t i = 0; i < a->size(); ++i)
            if (const double x = a->value(i, 0); std::isfinite(x))
                values.push_back(x);
            else
                ++missing;
    }
    return values;
}

/// The visible identifiers; empty if the legend has no space for them.
std::vector<std::uint64_t> few_identifiers(const Scene& scene, const std::string& attribute,
                                           const std::function<bool(const Part&)>& shows) {
    constexpr std::size_t most = 24;
    std::set<std::uint64_t> all;
    for (const Part& part : scene.parts) {
        if (shows && !shows(part)) continue;
        const Attribute* a = attribute_to_show(part.mesh, attribute);
        if (!a || a->role != Role::index) continue;
        for (std::size_t i = 0; i < a->size() && all.size() <= most; ++i)
            if (const double x = a->value(i, 0); x >= 0 && x != none)
                all.insert(static_cast<std::uint64_t>(x));
    }
    if (all.size() > most) return {};
    return {all.begin(), all.end()};
}

/// Narrows the range to percentiles if requested, or if outliers take up most of it.
void leave_outliers_out(std::vector<double>& values, ColourRange::Kind wanted, ValueRange& range) {
    using Kind = ColourRange::Kind;
    if (wanted != Kind::automatic && wanted != Kind::percentile) return;
    if (range.diverging) // absolute values, because the range is symmetric
        for (double& x : values) x = std::abs(x);
    const double high = percentile_of(values, 99), low = range.diverging ? -high : percentile_of(values, 1);
    // Uses halves, because the span of all doubles overflows.
    const bool outliers = high / 2 - low / 2 < (range.high / 2 - range.low / 2) / 2;
    if (!(low < high) || (wanted != Kind::percentile && !outliers)) return;
    range.low = low;
    range.high = high;
    range.percentiles = true;
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
    std::vector<double> values = finite_values(scene, attribute, shows, range.missing);
    if (values.empty()) {
        range.identifiers = few_identifiers(scene, attribute, shows);
        return range;
    }
    range.known = true;
    range.diverging = wanted.diverging;
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    range.min = range.low = *least;
    range.max = range.high = *most;
    if (wanted.kind == Kind::given) {
        range.low = wanted.min;
        range.high = wanted.max;
        return range;
    }
    if (range.diverging) {
        range.high = std::max(std::abs(range.min), std::abs(range.max));
        range.low = -range.high;
    }
    const double largest = std::max(std::abs(range.min), std::abs(range.max));
    if (wanted.kind == Kind::automatic && range.high - range.low <= wanted.lost * largest)
        range.low = range.high = range.min;
    else
        leave_outliers_out(values, wanted.kind, range);
    return range;
}

} // namespace facetmill
