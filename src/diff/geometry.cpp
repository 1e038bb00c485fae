#include "diff/lines.hpp"

#include "base/text/readable_numbers.hpp"
#include "diff/line_shape.hpp"
#include "diff/sides.hpp"
#include "geometry/triangulate/crossing_faces.hpp"

#include <cmath>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

/// Reports that only one file states its unit or its up axis.
void compare_frames(const Comparing& with) {
    const auto say = [&](const char* name, const char* a, const char* b) {
        if (std::string_view(a) != b)
            with.add("geometry", name, a, b, true,
                     "only one file states it; coordinates are compared unchanged");
    };
    say("unit", to_string(with.a.unit), to_string(with.b.unit));
    say("up", to_string(with.a.up), to_string(with.b.up));
}

/// The geometry of a scene for distances.
struct Shape {
    Surface surface, points; ///< its faces, and its unused vertices
    explicit Shape(const Scene& scene)
        : surface(surface_of(scene, filled_surface)), points(isolated_vertices_of(scene)) {}
    bool has_faces() const { return surface.size() > 0; }
    /// The faces, or the points of a cloud.
    const Surface& main() const { return has_faces() ? surface : points; }
    const char* kind() const { return has_faces() ? "surface" : points.size() > 0 ? "points" : "nothing"; }
};

/// Adds lines for the distances in both directions, compared with a limit.
class Distances {
  public:
    Distances(const Comparing& with, const DeviationResult& d) : with_(with), d_(d) {}

    void line(const char* name, double forward, double backward, const std::optional<Limit>& limit,
              const std::string& more = {}) const {
        const double value = std::max(forward, backward);
        const double most = !limit           ? HUGE_VAL
                            : limit->percent ? limit->amount / 100 * d_.diagonal
                                             : limit->amount;
        std::string note = std::isfinite(value) ? percentage(d_.percent(value), 4) + " of the diagonal"
                                                : "nothing to compare with";
        if (limit)
            note += limit->percent ? fmt::format(", limit {:g} %", limit->amount)
                                   : fmt::format(", limit {:g}", limit->amount);
        with_.add("geometry", name, finite_or_null(forward), finite_or_null(backward), value <= most,
                  note + more);
    }

  private:
    const Comparing& with_;
    const DeviationResult& d_;
};

/// Reports that faces may count with more area than they cover.
void compare_fans(const Comparing& with) {
    const auto fans = [](const Scene& scene) {
        std::size_t count = 0;
        for (const Part& part : scene.parts) count += count_fans(part.mesh);
        return count;
    };
    const std::size_t a = fans(with.a), b = fans(with.b);
    if (a + b > 0)
        with.add("geometry", "overlapping fans", a, b, true,
                 "non-planar faces that intersect themselves are measured as triangle fans");
}

/// Compares points of scenes with faces: the distance from each point to the nearest point of the other
/// scene.
void compare_isolated(const Comparing& with, const Shape& a, const Shape& b, const Distances& distances) {
    const auto isolated = [](const Shape& s) { return s.has_faces() ? s.points.size() : 0; };
    if (isolated(a) + isolated(b) == 0) return;
    const auto farthest = [&](const Shape& from, const Shape& to) {
        return isolated(from) == 0 ? DirectedDeviation{}
                                   : deviation_to(from.points, FaceTree(joined(to.surface, to.points)));
    };
    const DirectedDeviation f = farthest(a, b), g = farthest(b, a);
    const auto& worst = f.maximum >= g.maximum ? f : g;
    std::string more = fmt::format(", {} and {} vertices without faces", isolated(a), isolated(b));
    if (worst.maximum > 0 && std::isfinite(worst.maximum)) more += ", farthest at " + readable(worst.from);
    distances.line("isolated vertices maximum", f.maximum, g.maximum, maximum_of(with.settings), more);
}

/// Compares the distances between the lines of both scenes.
void compare_lines(const Comparing& with, const Distances& distances) {
    const LineShape a(with.a), b(with.b);
    if (a.lines.size() + b.lines.size() == 0) return;
    distances.line("lines maximum", a.distance_to(b), b.distance_to(a), maximum_of(with.settings));
}

} // namespace

std::optional<Limit> maximum_of(const ComparisonSettings& s) {
    return s.maximum || s.rms || s.mean ? s.maximum : Limit{1e-4, true};
}

void compare_geometry(const Comparing& with) {
    const auto& settings = with.settings;
    compare_frames(with);
    compare_fans(with);
    const Turned turned = turned_round(with.a, with.b);
    with.add("geometry", "reversed", false, turned.round, !turned.round, turned.note);
    const Shape a(with.a), b(with.b);
    with.result.geometry_a = a.kind();
    with.result.geometry_b = b.kind();
    const auto d = with.result.deviation = deviation(a.main(), b.main(), settings.deviation);
    const Distances distances(with, *d);
    const auto &f = d->forward, &g = d->backward;
    distances.line("deviation maximum", f.maximum, g.maximum, maximum_of(settings));
    distances.line("deviation rms", f.rms, g.rms, settings.rms);
    distances.line("deviation mean", f.mean, g.mean, settings.mean);
    if (f.bound && g.bound) distances.line("deviation bound", *f.bound, *g.bound, settings.maximum);
    compare_isolated(with, a, b, distances);
    compare_lines(with, distances);
}

} // namespace facetmill::report
