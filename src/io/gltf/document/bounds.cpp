// The minima and maxima of accessors.

#include "io/gltf/document/check.hpp"

#include "io/gltf/document/accessor_uses.hpp"
#include "io/gltf/document/builder.hpp"
#include "parallel/parallel.hpp"

#include <cmath>
#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

/// The accessors whose numbers Draco has.
std::vector<bool> of_draco(const Json& document) {
    std::vector<bool> all(count_of(document, "accessors"));
    const auto add = [&](const Json& index) { all[static_cast<std::size_t>(index.get<double>())] = true; };
    const Json::json_pointer draco("/extensions/KHR_draco_mesh_compression");
    for (std::size_t m = 0; m < count_of(document, "meshes"); ++m)
        for (const Json& primitive : document["meshes"][m]["primitives"]) {
            if (!primitive.contains(draco)) continue;
            for (const Json& attribute : primitive["attributes"]) add(attribute);
            if (primitive.contains("indices")) add(primitive["indices"]);
        }
    return all;
}

struct Bounds {
    std::vector<double> low, high;
};

/// The stored minima and maxima by component, before normalisation; none if a number is not finite.
std::optional<Bounds> bounds_of(const AttributeData& data, std::size_t components) {
    return std::visit(
        [&](const auto& numbers) -> std::optional<Bounds> {
            Bounds none_yet{std::vector<double>(components, HUGE_VAL),
                            std::vector<double>(components, -HUGE_VAL)};
            Bounds all = parallel_reduce(
                numbers.size() / components, none_yet,
                [&](std::size_t begin, std::size_t end) {
                    Bounds here = none_yet;
                    for (std::size_t i = begin * components; i < end * components; ++i) {
                        const auto x = static_cast<double>(numbers[i]);
                        // NaN makes the sum NaN, so that it is not lost in the comparisons.
                        if (!std::isfinite(x)) here.low[0] = NAN;
                        const std::size_t c = i % components;
                        if (x < here.low[c]) here.low[c] = x;
                        if (x > here.high[c]) here.high[c] = x;
                    }
                    return here;
                },
                [&](Bounds a, const Bounds& b) {
                    for (std::size_t c = 0; c < components; ++c) {
                        if (std::isnan(b.low[c]) || b.low[c] < a.low[c]) a.low[c] = b.low[c];
                        if (b.high[c] > a.high[c]) a.high[c] = b.high[c];
                    }
                    return a;
                });
            for (const double x : all.low)
                if (!std::isfinite(x)) return {};
            return all;
        },
        data);
}

/// The numbers in JSON; integers stay integers.
Json listed(const std::vector<double>& numbers, bool floats) {
    Json list = Json::array();
    for (const double x : numbers) {
        if (floats)
            list.push_back(x);
        else
            list.push_back(static_cast<std::int64_t>(x));
    }
    return list;
}

bool same(const Json& told, const std::vector<double>& numbers, bool floats) {
    if (told.size() != numbers.size()) return false;
    for (std::size_t c = 0; c < numbers.size(); ++c) {
        const double x = told[c].get<double>();
        if (floats ? static_cast<float>(x) != static_cast<float>(numbers[c]) : x != numbers[c]) return false;
    }
    return true;
}

} // namespace

bool correct_bounds(Json& document, Source& source, Breaches& breaches) {
    const std::vector<bool> needed = accessors_needing_bounds(document);
    const std::vector<bool> draco = of_draco(document);
    bool changed = false;
    for (std::size_t a = 0; a < needed.size(); ++a) {
        const JsonCursor place = item(document, "accessors", a);
        const bool told = place.find("min") || place.find("max");
        if ((!needed[a] && !told) || draco[a]) continue;
        // An extension may give numbers to accessors without bytes, so their bounds are only completed.
        const bool has_bytes = place.find("bufferView") || place.find("sparse");
        if (place.find("bufferView") && source.without_bytes(place.at("bufferView").natural())) continue;
        const Json reference = a;
        const Accessor of = accessor(source, JsonCursor(reference, fmt::format("accessors[{}]", a)));
        const auto bounds = bounds_of(decode(source, of), static_cast<std::size_t>(of.components));
        if (!bounds) continue;
        const bool floats = of.component_type == float32;
        for (const auto& [key, numbers] : {std::pair{"min", &bounds->low}, {"max", &bounds->high}}) {
            const auto found = place.find(key);
            if (found ? !has_bytes || same(found->json(), *numbers, floats) : !needed[a]) continue;
            breaches.add(place, fmt::format("\"{}\" is {}", key, found ? "wrong" : "missing"));
            document["accessors"][a][key] = listed(*numbers, floats);
            changed = true;
        }
    }
    return changed;
}

} // namespace facetmill::io::gltf
