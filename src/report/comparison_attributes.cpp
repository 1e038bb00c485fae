#include "report/comparison_lines.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace facetmill::report {

namespace {

struct Found {
    Json about;
    std::size_t elements = 0;
    std::vector<const Attribute*> arrays; ///< one per part that has it
};
using Attributes = std::map<std::pair<int, std::string>, Found>; ///< by domain and name

Attributes attributes_of(const Scene& scene) {
    Attributes all;
    for (const auto& part : scene.parts)
        for (const auto& attribute : part.mesh.attributes) {
            if (attribute.name == primitive_attribute && attribute.domain == Domain::face) continue;
            auto& found = all[{static_cast<int>(attribute.domain), attribute.name}];
            found.about = fmt::format("{} x {}", attribute.type(), attribute.components);
            found.elements += attribute.size();
            found.arrays.push_back(&attribute);
        }
    return all;
}

/// Values are compared where both sides have the same elements.
void compare_values(const Comparing& with, const std::string& name, const Json& about, const Found& a,
                    const Found& b) {
    const bool alike = a.arrays.size() == b.arrays.size() &&
                       std::equal(a.arrays.begin(), a.arrays.end(), b.arrays.begin(),
                                  [](const Attribute* x, const Attribute* y) {
                                      return x->size() == y->size() && x->components == y->components;
                                  });
    if (!alike) {
        with.add("attributes", name, about, about, true,
                 fmt::format("values not compared: {} and {} elements", a.elements, b.elements));
        return;
    }
    double most = 0;
    std::size_t where = 0, before = 0;
    for (std::size_t k = 0; k < a.arrays.size(); ++k) {
        const auto &x = *a.arrays[k], &y = *b.arrays[k];
        for (std::size_t i = 0; i < x.size(); ++i)
            for (int c = 0; c < x.components; ++c) {
                const double apart = std::abs(x.value(i, c) - y.value(i, c));
                if (!(apart <= most)) most = apart, where = before + i;
                if (!(most == most)) most = HUGE_VAL; // not a number on one side
            }
        before += x.size();
    }
    with.add("attributes", name, about, about, most <= with.settings.attribute_limit,
             most > 0 ? fmt::format("largest difference {:.4g}, at element {}", most, where) : "");
}

} // namespace

void compare_attributes(const Comparing& with) {
    const Attributes a = attributes_of(with.a), b = attributes_of(with.b);
    Attributes all = a;
    all.insert(b.begin(), b.end());
    for (const auto& [key, unused] : all) {
        const auto in_a = a.find(key), in_b = b.find(key);
        const Json about_a = in_a == a.end() ? Json(nullptr) : in_a->second.about;
        const Json about_b = in_b == b.end() ? Json(nullptr) : in_b->second.about;
        const std::string name = fmt::format("{} ({})", key.second, spelled(static_cast<Domain>(key.first)));
        if (about_a != about_b)
            with.add("attributes", name, about_a, about_b);
        else
            compare_values(with, name, about_a, in_a->second, in_b->second);
    }
}

} // namespace facetmill::report
