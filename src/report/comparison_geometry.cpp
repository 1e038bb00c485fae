#include "report/comparison_lines.hpp"

#include "geometry/surface_normal.hpp"
#include "mesh/placement.hpp"

#include <cmath>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

using Limit = ComparisonSettings::Limit;

/// Whether the second is inside out against the first: by the signs of the volumes, or, open, by which
/// way the faces look in all.
void compare_sides(const Comparing& with) {
    const auto looks = [](const Scene& scene) {
        Vec3 sum;
        for (const Part& part : scene.parts) {
            const Transform t = effective(part);
            for (Index f = 0; f < part.mesh.face_count(); ++f)
                sum += area_vector(part.mesh, f, t) * (t.determinant() < 0 ? -0.5 : 0.5);
        }
        return sum;
    };
    const Properties a = inspect(with.a), b = inspect(with.b);
    bool turned = false;
    if (a.volume && b.volume) {
        const auto solid = [](const Properties& p) { // more than rounding
            return std::abs(*p.volume) > 1e-12 * p.area * std::sqrt(p.area);
        };
        turned = solid(a) && solid(b) && (*a.volume < 0) != (*b.volume < 0);
    } else if (!a.volume && !b.volume) {
        const Vec3 u = looks(with.a), v = looks(with.b);
        turned = dot(u, v) < 0 && length(u) > 1e-6 * a.area && length(v) > 1e-6 * b.area;
    }
    with.add("geometry", "turned round", false, turned);
}

} // namespace

void compare_geometry(const Comparing& with) {
    const auto& settings = with.settings;
    compare_sides(with);
    const auto d = with.result.deviation =
        deviation(surface_of(with.a), surface_of(with.b), settings.deviation);
    const bool any = settings.maximum || settings.rms || settings.mean;
    const auto line = [&](const char* name, double forward, double backward,
                          const std::optional<Limit>& limit) {
        const double value = std::max(forward, backward);
        const double most = !limit           ? HUGE_VAL
                            : limit->percent ? limit->amount / 100 * d->diagonal
                                             : limit->amount;
        std::string note = std::isfinite(value) ? fmt::format("{:.4g} % of the diagonal", d->percent(value))
                                                : "nothing to compare with";
        if (limit)
            note += limit->percent ? fmt::format(", at most {:g} %", limit->amount)
                                   : fmt::format(", at most {:g}", limit->amount);
        const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); };
        with.add("geometry", name, number(forward), number(backward), value <= most, std::move(note));
    };
    const auto &f = d->forward, &b = d->backward;
    line("deviation maximum", f.maximum, b.maximum, any ? settings.maximum : Limit{1e-4, true});
    line("deviation rms", f.rms, b.rms, settings.rms);
    line("deviation mean", f.mean, b.mean, settings.mean);
    if (f.bound && b.bound) line("deviation bound", *f.bound, *b.bound, settings.maximum);
}

} // namespace facetmill::report
