#include "geometry/simplify.hpp"

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "geometry/simplify_surface.hpp"

namespace facetmill {

namespace {

using namespace simplification;
using Stop = SimplifyResult::Stop;

void check(const SimplifySettings& s) {
    if (!s.ratio && !s.faces && !s.vertices)
        throw Error(ErrorKind::usage, "E-RANGE", "simplify: a target is needed: ratio, faces or vertices");
    if (s.ratio && !(*s.ratio > 0 && *s.ratio <= 1))
        throw Error(ErrorKind::usage, "E-RANGE", "simplify: ratio is 0 < x <= 1, not " + spelled(*s.ratio));
}

/// The face count that the ratio asks for: rounded up, so that 10% of 15 faces is 2.
std::size_t share_of(std::size_t faces, double ratio) {
    return static_cast<std::size_t>(std::ceil(static_cast<double>(faces) * ratio - 1e-9));
}

struct Targets {
    Goal goal;
    std::size_t by_ratio = 0, by_faces = 0;

    Targets(const Surface& s, const SimplifySettings& settings) {
        if (settings.ratio) by_ratio = share_of(s.live_faces, *settings.ratio);
        if (settings.faces) by_faces = *settings.faces;
        goal.faces = std::max(by_ratio, by_faces);
        if (settings.vertices) goal.vertices = *settings.vertices;
    }

    bool met(const Surface& s) const {
        return s.live_faces <= goal.faces || s.live_vertices <= goal.vertices;
    }
    /// Which target stopped it.
    Stop reason(const Surface& s) const {
        if (s.live_faces > goal.faces) return Stop::vertices;
        return by_faces >= by_ratio ? Stop::faces : Stop::ratio;
    }
};

SimplifyResult::Blocked count_blocked(const Surface& s) {
    SimplifyResult::Blocked blocked;
    for (std::size_t c = 0; c < s.tri.size(); ++c) {
        if (!s.live(static_cast<Index>(c / 3))) continue;
        blocked.borders += (s.flags[c] & blocked_border) != 0;
        blocked.topology += (s.flags[c] & blocked_topology) != 0;
        blocked.flips += (s.flags[c] & blocked_flip) != 0;
    }
    return blocked;
}

/// Attributes that follow vertices: those of vertices, and those of wedges where every vertex is one wedge.
bool vertices_carry(const Mesh& mesh) {
    for (const auto& a : mesh.attributes)
        if (a.domain == Domain::vertex || (a.domain == Domain::wedge && !mesh.has_seams())) return true;
    return false;
}

Fates all_kept(const Mesh& mesh) {
    Fates fates;
    for (const auto& a : mesh.attributes) fates.push_back({a.name, a.domain, Fate::Kind::kept, ""});
    return fates;
}

} // namespace

SimplifyResult simplify(Mesh given, const SimplifySettings& settings) {
    check(settings);
    SimplifyResult result;
    result.faces_given = given.face_count();
    const bool polygons = !given.all_triangles();
    const Mesh cut = polygons ? triangulated(given) : Mesh{};
    const Mesh& mesh = polygons ? cut : given;
    Surface s = build_surface(mesh);
    result.faces_before = result.faces_after = s.live_faces;
    result.vertices_before = result.vertices_after = s.live_vertices;
    const Targets targets(s, settings);
    if (targets.met(s)) {
        result.fates = all_kept(given);
        result.mesh = std::move(given);
        return result;
    }
    classify(s, mesh, settings.boundary);
    if (settings.method == SimplifySettings::Method::quadric) sum_quadrics(s);
    s.log_vertices = vertices_carry(mesh);
    const Outcome done = run_passes(s, targets.goal);
    result.stop = done.stuck ? Stop::stuck : targets.reason(s);
    if (done.stuck) result.blocked = count_blocked(s);
    result.passes = done.passes, result.collapses = done.collapses;
    result.largest_error = std::sqrt(done.largest) / s.scale;
    result.faces_after = s.live_faces, result.vertices_after = s.live_vertices;
    result.mesh = finished(s, mesh, result.fates);
    return result;
}

} // namespace facetmill
