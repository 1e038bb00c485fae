#include "geometry/simplify.hpp"

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "base/parallel.hpp"
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

/// Whether anything but positions and faces must be followed.
bool carries_attributes(const Mesh& mesh) {
    return std::any_of(mesh.attributes.begin(), mesh.attributes.end(),
                       [](const auto& a) { return a.domain != Domain::face; });
}

Fates all_kept(const Mesh& mesh) {
    Fates fates;
    for (const auto& a : mesh.attributes) fates.push_back({a.name, a.domain, Fate::Kind::kept, ""});
    return fates;
}

/// What the work is done on: triangles, without the seams that only normals make.
struct Prepared {
    std::optional<Mesh> own; ///< none: the mesh as given will do
    NormalSeams seams;

    Prepared(const Mesh& given, const SimplifySettings& settings) {
        if (given.has_seams() && given.find("NORMAL", Domain::wedge)) {
            seams = merge_normal_seams(own.emplace(given), settings.crease);
            if (seams.merged == 0) own.reset();
        }
        if (!given.all_triangles()) own = triangulated(own ? *own : given);
    }
};

/// Gives a flat-shaded mesh its normals back, and says what became of normals.
void settle_normals(Mesh& mesh, const NormalSeams& seams, Fates& fates) {
    using Shading = NormalSeams::Shading;
    if (seams.shading == Shading::as_given) return;
    if (seams.shading == Shading::faceted) set_facet_normals(mesh);
    for (Fate& fate : fates) {
        if (fate.domain != Domain::wedge) continue;
        if (fate.attribute == "NORMAL")
            fate = {
                fate.attribute, fate.domain, Fate::Kind::recomputed,
                seams.shading == Shading::faceted
                    ? "flat shading: the normals of the new faces"
                    : "area-weighted where seams below the crease angle were merged, interpolated elsewhere"};
        else if (fate.attribute == "TANGENT")
            fate = {fate.attribute, fate.domain, Fate::Kind::interpolated,
                    "one of each merged normal seam, mixed at new elements"};
    }
}

/// The features as they are before the first collapse, by the corners of the mesh.
void remember_features(Surface& s) {
    if (!s.has_features || !s.logging) return;
    s.features_given.resize(s.flags.size());
    parallel_for(s.flags.size(), [&](std::size_t c) {
        s.features_given[3 * s.face_source[c / 3] + c % 3] = s.flags[c] & feature_edge;
    });
}

} // namespace

SimplifyResult simplify(Mesh given, const SimplifySettings& settings) {
    check(settings);
    SimplifyResult result;
    result.faces_given = given.face_count();
    const Prepared prepared(given, settings);
    const Mesh& mesh = prepared.own ? *prepared.own : given;
    result.shading = prepared.seams.shading, result.merged_wedges = prepared.seams.merged;
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
    s.logging = carries_attributes(mesh);
    remember_features(s);
    const Outcome done = run_passes(s, targets.goal);
    result.stop = done.stuck ? Stop::stuck : targets.reason(s);
    if (done.stuck) result.blocked = count_blocked(s);
    result.passes = done.passes, result.collapses = done.collapses;
    result.largest_error = std::sqrt(done.largest) / s.scale;
    result.faces_after = s.live_faces, result.vertices_after = s.live_vertices;
    result.mesh = finished(s, mesh, result.fates);
    settle_normals(result.mesh, prepared.seams, result.fates);
    return result;
}

} // namespace facetmill
