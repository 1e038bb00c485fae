#include "geometry/split/split.hpp"

#include "base/error.hpp"
#include "base/math/portable_math.hpp"
#include "base/progress.hpp"
#include "geometry/split/estimate.hpp"
#include "geometry/split/marked.hpp"
#include "geometry/split/patterns.hpp"
#include "geometry/split/smooth.hpp"
#include "geometry/split/spots.hpp"
#include "mesh/fetch_points.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <array>
#include <fmt/format.h>

namespace facetmill {

namespace {

/// The properties of a method, except the way it splits.
struct MethodRow {
    SplitMethod method;
    const char* name;  ///< the name as users write it
    Index max_corners; ///< largest accepted number of corners; 0: any
    bool halves_edges; ///< every face with n corners becomes n or four faces, and all edges are cut
    bool smooth;       ///< the method moves the surface
};

constexpr auto method_rows = [] {
    using enum SplitMethod;
    return std::to_array<MethodRow>({
        {midpoint, "midpoint", 0, true, false},
        {bisect, "bisect", 3, false, false},
        {notch, "notch", 3, false, false},
        {centroid, "centroid", 0, false, false},
        {grid, "grid", 4, false, false},
        {quads, "quads", 0, true, false},
        {halve, "halve", 4, false, false},
        {fan, "fan", 0, false, false},
        {varignon, "varignon", 0, false, false},
        {core, "core", 0, false, false},
        {diagonal, "diagonal", 4, false, false},
        {loop, "loop", 3, true, true},
        {sqrt3, "sqrt3", 3, false, true},
        {butterfly, "butterfly", 3, true, true},
        {catmull_clark, "catmull-clark", 0, true, true},
    });
}();

constexpr bool rows_are_in_order() {
    for (std::size_t i = 0; i < method_rows.size(); ++i)
        if (method_rows[i].method != static_cast<SplitMethod>(i)) return false;
    return method_rows.size() == static_cast<std::size_t>(SplitMethod::catmull_clark) + 1;
}
static_assert(rows_are_in_order(), "a row for each method, in the order of the enumeration");

const MethodRow& row_of(SplitMethod method) { return method_rows[static_cast<std::size_t>(method)]; }

void check_polygons(const Mesh& mesh, const SplitSettings& settings) {
    const Index most = row_of(settings.method).max_corners;
    if (most == 0 || mesh.all_triangles()) return;
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (mesh.face_size(f) > most)
            throw Error(ErrorKind::stage, "E-POLYGON",
                        fmt::format("{}: {} takes faces of at most {} corners, face {} has {}",
                                    settings.words.subject, to_string(settings.method), most, f,
                                    mesh.face_size(f)),
                        most == 4 ? "use 'split: quads' first to make quads of every face"
                                  : "use triangulate first to make triangles of every face");
}

/// One pass. Adds attribute changes and counts of problem spots to the result. Returns no faces if min_angle
/// finds no narrow face.
Mesh split_once(const Mesh& mesh, const SplitSettings& settings, SplitResult& so_far) {
    AttributeChanges& changes = so_far.changes;
    so_far.folded += folding_faces(mesh, settings.method);
    const auto with_points = [&](int pieces, const auto& pattern) {
        const EdgeTable table = build_edges(mesh);
        if (pieces > 1) so_far.shared += shared_cuts(mesh, table, {});
        const EdgePoints points(mesh, table, pieces);
        return apply_pattern(mesh, &points, pattern, changes);
    };
    switch (settings.method) {
    case SplitMethod::midpoint:
        return with_points(2, QuadsPattern{true});
    case SplitMethod::grid:
        return with_points(settings.grid, GridPattern{settings.grid});
    case SplitMethod::quads:
    case SplitMethod::varignon: {
        const EdgeTable table = build_edges(mesh);
        const EdgePoints points(mesh, table, 2);
        if (settings.method == SplitMethod::quads)
            return apply_pattern(mesh, &points, QuadsPattern{}, changes);
        const auto shared = shared_corners(mesh, table);
        return apply_pattern(mesh, &points, VarignonPattern{shared}, changes);
    }
    case SplitMethod::centroid:
        return apply_pattern(mesh, nullptr, CentroidPattern{}, changes);
    case SplitMethod::fan:
        return apply_pattern(mesh, nullptr, FanPattern{}, changes);
    case SplitMethod::core:
        return apply_pattern(mesh, nullptr, CorePattern{}, changes);
    case SplitMethod::diagonal: {
        const QuadCuts cuts = mesh.all_triangles() ? QuadCuts{} : quad_cuts(mesh);
        so_far.shared += cuts.coinciding;
        return apply_pattern(mesh, nullptr, DiagonalPattern{cuts.at_second}, changes);
    }
    case SplitMethod::bisect:
    case SplitMethod::notch:
    case SplitMethod::halve:
        return split_marked(mesh, settings, so_far).value_or(Mesh{});
    case SplitMethod::loop:
    case SplitMethod::sqrt3:
    case SplitMethod::butterfly:
    case SplitMethod::catmull_clark:
        break;
    }
    return split_smooth(mesh, settings, so_far.passes, changes);
}

/// Whether the mesh meets the target; false if no target can be tested.
bool is_reached(const Mesh& mesh, const SplitSettings& settings) {
    return settings.max_edge > 0 && facet_shape(mesh, settings.to_world).longest_edge <= settings.max_edge;
}

/// The expected duration of each pass, if it is known in advance: methods that halve edges replace a face by
/// four.
std::vector<double> lengths_of_passes(const Mesh& mesh, const SplitSettings& s) {
    double passes = std::min(s.passes, 16);
    if (s.max_edge > 0) {
        const double halvings = facet_shape(mesh, s.to_world).longest_edge / s.max_edge;
        while (passes > 0 && halvings <= std::ldexp(1.0, static_cast<int>(passes) - 1)) --passes;
    }
    const double faces = static_cast<double>(std::max<std::size_t>(1, mesh.face_count()));
    while (s.max_faces > 0 && passes > 1 &&
           std::ldexp(faces, 2 * static_cast<int>(passes)) > static_cast<double>(s.max_faces))
        --passes;
    std::vector<double> lengths;
    lengths.reserve(static_cast<std::size_t>(std::max(passes, 0.0)));
    for (int pass = 0; pass < passes; ++pass)
        lengths.push_back(s.min_angle > 0 ? 1 : std::ldexp(1.0, 2 * pass));
    return lengths;
}

/// Passes over all faces, as many as the settings allow and the targets need.
SplitResult repeated(const Mesh& mesh, const SplitSettings& settings) {
    using Stop = SplitResult::Stop;
    SplitResult result;
    const Mesh* from = &mesh;
    if (settings.min_angle > 0)
        result.narrow = result.narrow_before = narrow_faces(triangulated(mesh), settings);
    for (ProgressSteps steps(lengths_of_passes(mesh, settings));; steps.next()) {
        if (is_reached(*from, settings)) {
            result.stop = Stop::target;
            break;
        }
        if (result.passes >= settings.passes) break;
        const bool quads_left = settings.method == SplitMethod::notch && result.passes > 0;
        const Mesh triangles = quads_left ? triangulated(*from) : Mesh{};
        const Mesh& next_from = quads_left ? triangles : *from;
        SplitCensus next(next_from);
        next.pass(settings.method, settings.grid);
        if (settings.max_faces > 0 && next.faces() > static_cast<double>(settings.max_faces)) {
            result.stop = Stop::budget;
            break;
        }
        refuse_giant_split(next_from, next.corners(), settings.words);
        check_polygons(next_from, settings);
        const std::size_t folded = result.folded, shared = result.shared;
        Mesh finer = split_once(next_from, settings, result);
        if (settings.min_angle > 0) {
            if (finer.face_count() == 0) {
                result.stop = Stop::target; // no triangle is narrow
                break;
            }
            const std::size_t narrow = narrow_faces(triangulated(finer), settings);
            if (narrow > result.narrow) {
                result.stop = Stop::narrow;
                result.folded = folded;
                result.shared = shared;
                break;
            }
            result.narrow = narrow;
        }
        result.mesh = std::move(finer);
        from = &result.mesh;
        ++result.passes;
    }
    if (from == &mesh) result.mesh = mesh;
    result.added = result.mesh.face_count() - mesh.face_count();
    return result;
}

} // namespace

bool is_smooth(SplitMethod method) { return row_of(method).smooth; }

const char* to_string(SplitMethod method) { return row_of(method).name; }

std::optional<Refusal> check_split_targets(const SplitSettings& s) {
    const auto unreachable = [&](const char* target, const char* knows) {
        return Refusal{target, fmt::format("{} cannot reach the target '{}'", to_string(s.method), target),
                       fmt::format("use {}", knows)};
    };
    if (s.max_edge > 0 && s.method != SplitMethod::bisect && !row_of(s.method).halves_edges)
        return unreachable("max_edge", "bisect, midpoint, quads, loop, butterfly or catmull-clark");
    if (s.min_angle > 0 && s.method != SplitMethod::bisect && s.method != SplitMethod::notch)
        return unreachable("min_angle", "bisect or notch");
    const char* target = s.max_edge > 0    ? "max_edge"
                         : s.min_angle > 0 ? "min_angle"
                         : s.max_faces > 0 ? "max_faces"
                                           : nullptr;
    if (s.cut == SplitSettings::Cut::widest_angle && target)
        return Refusal{"cut",
                       fmt::format("'cut: widest-angle' cannot be combined with the target '{}', because its "
                                   "cuts may never reach it",
                                   target),
                       "leave out cut, or give passes and no target"};
    if (s.min_angle > 0 && (s.max_edge > 0 || s.max_faces > 0))
        return Refusal{"min_angle", "'min_angle' cannot be combined with another target",
                       "use two split stages"};
    return {};
}

SplitResult split(const Mesh& mesh, const SplitSettings& settings) {
    throw_refusal("split", check_split_targets(settings));
    check_polygons(mesh, settings);
    if (settings.min_angle <= 0)
        refuse_giant_split(mesh, split_corner_estimate(mesh, settings), settings.words);
    if (is_smooth(settings.method) && settings.passes > 0) require_manifold(mesh, settings.method);
    if (settings.method == SplitMethod::bisect && (settings.max_edge > 0 || settings.max_faces > 0))
        return refine(mesh, settings);
    return repeated(mesh, settings);
}

SplitResult grid_split(const Mesh& mesh, int n, const SplitWords& words) {
    SplitSettings settings;
    settings.words = words;
    settings.method = SplitMethod::grid;
    settings.grid = n;
    return split(mesh, settings);
}

namespace {

struct Extremes {
    double squared = 0; ///< squared length of the longest edge
    double cosine = -1; ///< cosine of the smallest angle
};

Extremes join(Extremes a, const Extremes& b) {
    return {std::max(a.squared, b.squared), std::max(a.cosine, b.cosine)};
}

Extremes extremes(const Mesh& mesh, Index f, const Transform& to_world) {
    Extremes e;
    const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
    Vec3 in = to_world.vector(mesh.point(begin) - mesh.point(end - 1));
    for (Index c = begin; c < end; ++c) {
        const Vec3 out = to_world.vector(mesh.point(next_corner(mesh, f, c)) - mesh.point(c));
        const double size = std::sqrt(dot(in, in) * dot(out, out));
        e.squared = std::max(e.squared, dot(out, out));
        if (size > 0) e.cosine = std::max(e.cosine, -dot(in, out) / size);
        in = out;
    }
    return e;
}

} // namespace

FacetShape facet_shape(const Mesh& mesh, const Transform& to_world) {
    if (mesh.face_count() == 0) return {};
    const Extremes all = parallel_reduce(
        mesh.face_count(), Extremes{},
        [&](std::size_t begin, std::size_t end) {
            Extremes e;
            for (auto f = static_cast<Index>(begin); f < end; ++f) {
                fetch_points_soon(mesh, f);
                e = join(e, extremes(mesh, f, to_world));
            }
            return e;
        },
        join);
    return {std::sqrt(all.squared), arc_cosine(all.cosine)};
}

double mean_edge(const Mesh& mesh, const Transform& to_world) {
    const double sum = parallel_reduce(
        mesh.face_count(), 0.0,
        [&](std::size_t begin, std::size_t end) {
            double s = 0;
            for (auto f = static_cast<Index>(begin); f < end; ++f)
                for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
                    s += length(to_world.vector(mesh.point(next_corner(mesh, f, c)) - mesh.point(c)));
            return s;
        },
        [](double a, double b) { return a + b; });
    return mesh.corner_count() > 0 ? sum / static_cast<double>(mesh.corner_count()) : 0;
}

} // namespace facetmill
