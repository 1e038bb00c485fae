#include "report/comparison.hpp"

#include "geometry/surface_normal.hpp"
#include "mesh/placement.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace facetmill::report {

namespace {

using Limit = ComparisonSettings::Limit;

class Comparer {
  public:
    Comparer(const Scene& a, const Scene& b, const ComparisonSettings& settings)
        : a_(a), b_(b), settings_(settings) {}

    Comparison run() {
        properties();
        if (!settings_.ignored.contains("geometry")) geometry();
        attributes();
        names("materials", a_.materials, b_.materials);
        names("parts", a_.parts, b_.parts);
        result_.ignored = settings_.ignored;
        return std::move(result_);
    }

  private:
    void add(const char* section, std::string name, Json a, Json b, bool same, std::string note = {}) {
        result_.lines.push_back(
            {section, std::move(name), std::move(a), std::move(b), same, std::move(note)});
    }
    void add(const char* section, std::string name, const Json& a, const Json& b) {
        add(section, std::move(name), a, b, a == b);
    }

    void properties() {
        const Properties a = inspect(a_), b = inspect(b_);
        static const std::set<std::string_view> counts{"vertices", "wedges", "edges", "faces", "triangles"};
        const auto value = [](const Property& p, const Properties& of) -> Json {
            const auto x = p.get(of);
            if (!x) return nullptr;
            return p.truth() ? Json(*x != 0) : Json(static_cast<std::int64_t>(*x));
        };
        for (const auto& p : property_table()) {
            const bool counted = p.kind == PropertyKind::count || p.truth();
            if (!counted || p.costly || p.of_scene || p.quality) continue;
            add(counts.contains(p.name) ? "counts" : "topology", std::string(p.name), value(p, a),
                value(p, b));
        }
    }

    /// Whether the second is inside out against the first: by the signs of the volumes, or, open, by which
    /// way the faces look in all.
    void sides() {
        const auto looks = [](const Scene& scene) {
            Vec3 sum;
            for (const Part& part : scene.parts) {
                const Transform t = effective(part);
                for (Index f = 0; f < part.mesh.face_count(); ++f)
                    sum += area_vector(part.mesh, f, t) * (t.determinant() < 0 ? -0.5 : 0.5);
            }
            return sum;
        };
        const Properties a = inspect(a_), b = inspect(b_);
        bool turned = false;
        if (a.volume && b.volume) {
            const auto solid = [](const Properties& p) { // more than rounding
                return std::abs(*p.volume) > 1e-12 * p.area * std::sqrt(p.area);
            };
            turned = solid(a) && solid(b) && (*a.volume < 0) != (*b.volume < 0);
        } else if (!a.volume && !b.volume) {
            const Vec3 u = looks(a_), v = looks(b_);
            turned = dot(u, v) < 0 && length(u) > 1e-6 * a.area && length(v) > 1e-6 * b.area;
        }
        add("geometry", "turned round", false, turned);
    }

    void geometry() {
        sides();
        const auto d = result_.deviation = deviation(surface_of(a_), surface_of(b_), settings_.deviation);
        const bool any = settings_.maximum || settings_.rms || settings_.mean;
        const auto line = [&](const char* name, double forward, double backward,
                              const std::optional<Limit>& limit) {
            const double value = std::max(forward, backward);
            const double most = !limit           ? HUGE_VAL
                                : limit->percent ? limit->amount / 100 * d->diagonal
                                                 : limit->amount;
            std::string note = std::isfinite(value)
                                   ? fmt::format("{:.4g} % of the diagonal", d->percent(value))
                                   : "nothing to compare with";
            if (limit)
                note += limit->percent ? fmt::format(", at most {:g} %", limit->amount)
                                       : fmt::format(", at most {:g}", limit->amount);
            const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); };
            add("geometry", name, number(forward), number(backward), value <= most, std::move(note));
        };
        const auto &f = d->forward, &b = d->backward;
        line("deviation maximum", f.maximum, b.maximum, any ? settings_.maximum : Limit{1e-4, true});
        line("deviation rms", f.rms, b.rms, settings_.rms);
        line("deviation mean", f.mean, b.mean, settings_.mean);
        if (f.bound && b.bound) line("deviation bound", *f.bound, *b.bound, settings_.maximum);
    }

    struct Found {
        Json about;
        std::size_t elements = 0;
        std::vector<const Attribute*> arrays; ///< one per part that has it
    };
    using Attributes = std::map<std::pair<int, std::string>, Found>; ///< by domain and name

    static Attributes attributes_of(const Scene& scene) {
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

    void attributes() {
        const Attributes a = attributes_of(a_), b = attributes_of(b_);
        Attributes all = a;
        all.insert(b.begin(), b.end());
        for (const auto& [key, unused] : all) {
            const auto in_a = a.find(key), in_b = b.find(key);
            const Json about_a = in_a == a.end() ? Json(nullptr) : in_a->second.about;
            const Json about_b = in_b == b.end() ? Json(nullptr) : in_b->second.about;
            const std::string name =
                fmt::format("{} ({})", key.second, spelled(static_cast<Domain>(key.first)));
            if (about_a != about_b)
                add("attributes", name, about_a, about_b);
            else
                values(name, about_a, in_a->second, in_b->second);
        }
    }

    /// Values are compared where both sides have the same elements.
    void values(const std::string& name, const Json& about, const Found& a, const Found& b) {
        const bool alike = a.arrays.size() == b.arrays.size() &&
                           std::equal(a.arrays.begin(), a.arrays.end(), b.arrays.begin(),
                                      [](const Attribute* x, const Attribute* y) {
                                          return x->size() == y->size() && x->components == y->components;
                                      });
        if (!alike) {
            add("attributes", name, about, about, true,
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
        add("attributes", name, about, about, most <= settings_.attribute_limit,
            most > 0 ? fmt::format("largest difference {:.4g}, at element {}", most, where) : "");
    }

    template <class List>
    void names(const char* section, const List& a, const List& b) {
        const std::size_t count = std::max(a.size(), b.size());
        add(section, "number", a.size(), b.size());
        for (std::size_t i = 0; i < count; ++i)
            add(section, fmt::format("{}", i), i < a.size() ? Json(a[i].name) : Json(nullptr),
                i < b.size() ? Json(b[i].name) : Json(nullptr));
    }

    const Scene &a_, &b_;
    const ComparisonSettings& settings_;
    Comparison result_;
};

} // namespace

bool Comparison::differs() const {
    return std::any_of(lines.begin(), lines.end(),
                       [&](const Difference& d) { return !d.same && !ignored.contains(d.section); });
}

Comparison compare(const Scene& a, const Scene& b, const ComparisonSettings& settings) {
    return Comparer(a, b, settings).run();
}

} // namespace facetmill::report
