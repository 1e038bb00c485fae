#include "diff/lines.hpp"
#include "mesh/placement.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <list>
#include <map>

namespace facetmill::report {

namespace {

struct FoundAttribute {
    std::set<std::string> types; ///< types in all parts that have it
    std::size_t elements = 0;
    std::vector<const Attribute*> arrays; ///< an array for each part that has it

    Json about() const { return fmt::format("{}", fmt::join(types, ", ")); }
};
using Attributes = std::map<std::pair<int, std::string>, FoundAttribute>; ///< by domain and name

bool turns_with_part(const Attribute& a) {
    return a.role == Role::normal || a.role == Role::tangent || a.role == Role::morph_vector;
}

/// The directions of rotated parts in world space; other attributes do not change.
class WorldAttributes {
  public:
    explicit WorldAttributes(const Scene& scene) {
        for (const auto& part : scene.parts) {
            const Transform to_world = part.transform;
            for (const auto& attribute : part.mesh.attributes) {
                if (attribute.name == primitive_attribute && attribute.domain == Domain::face) continue;
                const bool turned = turns_with_part(attribute) && !to_world.identity();
                add(turned ? in_world(attribute, to_world) : attribute);
            }
        }
    }
    const Attributes& all() const { return all_; }

  private:
    const Attribute& in_world(const Attribute& attribute, const Transform& to_world) {
        Mesh& alone = turned_.emplace_back();
        alone.attributes.push_back(attribute);
        apply(alone, to_world);
        return alone.attributes.front();
    }
    void add(const Attribute& attribute) {
        auto& found = all_[{static_cast<int>(attribute.domain), attribute.name}];
        found.types.insert(fmt::format("{} x {}", attribute.type(), attribute.components));
        found.elements += attribute.size();
        found.arrays.push_back(&attribute);
    }

    Attributes all_;
    std::list<Mesh> turned_;
};

/// The difference: 0 for equal numbers, including infinities and NaN; infinity if only one is NaN.
double apart(double x, double y) {
    if (x == y || (std::isnan(x) && std::isnan(y))) return 0;
    const double d = std::abs(x - y);
    return std::isnan(d) ? HUGE_VAL : d;
}

/// Compares values if both sides have the same elements.
void compare_values(const Comparing& with, const std::string& name, const FoundAttribute& a,
                    const FoundAttribute& b) {
    const bool alike = std::equal(a.arrays.begin(), a.arrays.end(), b.arrays.begin(), b.arrays.end(),
                                  [](const Attribute* x, const Attribute* y) {
                                      return x->size() == y->size() && x->components == y->components;
                                  });
    if (!alike)
        return with.leave("attributes", name, a.about(), b.about(),
                          fmt::format("the numbers of elements differ, {} and {}", a.elements, b.elements));
    double most = 0;
    std::size_t where = 0, before = 0;
    for (std::size_t k = 0; k < a.arrays.size(); ++k) {
        const auto &x = *a.arrays[k], &y = *b.arrays[k];
        for (std::size_t i = 0; i < x.size(); ++i)
            for (int c = 0; c < x.components; ++c) {
                const double d = apart(x.value(i, c), y.value(i, c));
                if (d > most) {
                    most = d;
                    where = before + i;
                }
            }
        before += x.size();
    }
    with.add("attributes", name, a.about(), b.about(), most <= with.settings.attribute_limit,
             most > 0 ? fmt::format("largest difference {:.4g}, at element {}", most, where) : "");
}

} // namespace

void compare_attributes(const Comparing& with) {
    const WorldAttributes of_a(with.a), of_b(with.b);
    const Attributes &a = of_a.all(), &b = of_b.all();
    Attributes all = a;
    all.insert(b.begin(), b.end());
    for (const auto& [key, unused] : all) {
        const auto in_a = a.find(key), in_b = b.find(key);
        const Json about_a = in_a == a.end() ? Json(nullptr) : in_a->second.about();
        const Json about_b = in_b == b.end() ? Json(nullptr) : in_b->second.about();
        const std::string name =
            fmt::format("{} ({})", key.second, to_string(static_cast<Domain>(key.first)));
        if (about_a != about_b)
            with.add("attributes", name, about_a, about_b);
        else
            compare_values(with, name, in_a->second, in_b->second);
    }
}

} // namespace facetmill::report
