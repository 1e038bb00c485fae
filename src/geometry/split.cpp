#include "geometry/split.hpp"

#include "base/error.hpp"
#include "base/memory.hpp"
#include "geometry/split_marked.hpp"
#include "geometry/split_patterns.hpp"
#include "geometry/split_smooth.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

constexpr double corner_limit = 2147483648.0; ///< 2^31
/// Of memory, at the peak: the result, the edges it comes from, and where everything descends from.
constexpr double bytes_per_corner = 36;

/// The most corners of a face that the method knows; 0: any.
Index most_corners(SplitMethod method) {
    switch (method) {
    case SplitMethod::grid:
    case SplitMethod::halve:
    case SplitMethod::diagonal:
        return 4;
    case SplitMethod::bisect:
    case SplitMethod::notch:
    case SplitMethod::loop:
    case SplitMethod::sqrt3:
    case SplitMethod::butterfly:
        return 3;
    default:
        return 0;
    }
}

void check_polygons(const Mesh& mesh, SplitMethod method) {
    const Index most = most_corners(method);
    if (most == 0 || mesh.all_triangles()) return;
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (mesh.face_size(f) > most)
            throw Error(ErrorKind::stage, "E-POLYGON",
                        fmt::format("split: {} takes faces of at most {} corners, face {} has {}",
                                    spelled(method), most, f, mesh.face_size(f)),
                        most == 4 ? "'split: quads' before it makes quads of every face"
                                  : "'triangulate' before it makes triangles of every face");
}

/// Whether every face becomes as many as it has corners, or four, and all edges are cut.
bool halves_edges(SplitMethod m) {
    return m == SplitMethod::midpoint || m == SplitMethod::quads || m == SplitMethod::loop ||
           m == SplitMethod::butterfly || m == SplitMethod::catmull_clark;
}

Mesh split_once(const Mesh& mesh, const SplitSettings& settings, int pass, Fates& fates) {
    const auto with_points = [&](int pieces, const auto& pattern) {
        const EdgeTable table = build_edges(mesh);
        const EdgePoints points(mesh, table, pieces);
        return apply_pattern(mesh, &points, pattern, fates);
    };
    switch (settings.method) {
    case SplitMethod::midpoint:
        return with_points(2, QuadsPattern{true});
    case SplitMethod::quads:
        return with_points(2, QuadsPattern{});
    case SplitMethod::varignon:
        return with_points(2, VarignonPattern{});
    case SplitMethod::grid:
        return with_points(settings.grid, GridPattern{settings.grid});
    case SplitMethod::centroid:
        return apply_pattern(mesh, nullptr, CentroidPattern{}, fates);
    case SplitMethod::fan:
        return apply_pattern(mesh, nullptr, FanPattern{}, fates);
    case SplitMethod::core:
        return apply_pattern(mesh, nullptr, CorePattern{}, fates);
    case SplitMethod::diagonal:
        return apply_pattern(mesh, nullptr, DiagonalPattern{}, fates);
    case SplitMethod::bisect:
    case SplitMethod::notch:
    case SplitMethod::halve:
        return split_marked(mesh, settings, fates).value_or(Mesh{});
    default:
        return split_smooth(mesh, settings, pass, fates);
    }
}

/// How the numbers of triangles, quads and larger faces, and the corners of these, change in one pass.
struct Census {
    double triangles = 0, quads = 0, larger = 0, larger_corners = 0;

    explicit Census(const Mesh& mesh) {
        if (mesh.all_triangles()) {
            triangles = static_cast<double>(mesh.face_count());
            return;
        }
        for (Index f = 0; f < mesh.face_count(); ++f) {
            const Index n = mesh.face_size(f);
            if (n == 3)
                ++triangles;
            else if (n == 4)
                ++quads;
            else
                ++larger, larger_corners += n;
        }
    }
    double corners() const { return 3 * triangles + 4 * quads + larger_corners; }
    double faces() const { return triangles + quads + larger; }
    void set(double t, double q, double l, double c) {
        triangles = t, quads = q, larger = l, larger_corners = c;
    }
    void pass(SplitMethod method, double n) {
        switch (method) {
        case SplitMethod::midpoint:
        case SplitMethod::loop:
        case SplitMethod::butterfly:
            return set(4 * triangles, 4 * quads + larger_corners, 0, 0);
        case SplitMethod::quads:
        case SplitMethod::catmull_clark:
            return set(0, corners(), 0, 0);
        case SplitMethod::bisect:
            return set(4 * triangles, quads, larger, larger_corners);
        case SplitMethod::notch: // 4 triangles have more corners than a triangle and a quad
            return set(4 * triangles, 0, larger, larger_corners);
        case SplitMethod::halve:
            return set(4 * triangles, 4 * quads, larger, larger_corners);
        case SplitMethod::centroid:
            return set(corners(), 0, 0, 0);
        case SplitMethod::fan:
            return set(triangles + 4 * quads + larger_corners, 0, 0, 0);
        case SplitMethod::sqrt3:
            return set(3 * triangles, quads, larger, larger_corners);
        case SplitMethod::grid:
            return set(n * n * triangles, n * n * quads, larger, larger_corners);
        case SplitMethod::varignon:
            return set(triangles + corners(), quads, larger, larger_corners);
        case SplitMethod::core:
            return set(triangles, quads + corners(), larger, larger_corners);
        case SplitMethod::diagonal:
            return set(triangles + 2 * quads, 0, larger, larger_corners);
        }
    }
};

/// About how many triangles refining to max_edge makes: a triangle with all edges that long has at most
/// sqrt(3) / 4 of its square as area, and cuts leave it smaller than that.
double refined_estimate(const Mesh& mesh, const SplitSettings& s) {
    constexpr double fullest = 0.3;
    return parallel_reduce(
        mesh.face_count(), 0.0,
        [&](std::size_t begin, std::size_t end) {
            double sum = 0;
            for (std::size_t f = begin; f < end; ++f) {
                const auto c = static_cast<Index>(3 * f);
                const Vec3 a = s.to_world.vector(mesh.point(c + 1) - mesh.point(c)),
                           b = s.to_world.vector(mesh.point(c + 2) - mesh.point(c));
                const double area = length(cross(a, b)) / 2,
                             longest = std::max({length(a), length(b), length(b - a)});
                sum += std::max({1.0, longest / s.max_edge, area / (fullest * s.max_edge * s.max_edge)});
            }
            return sum;
        },
        [](double a, double b) { return a + b; });
}

/// Of all attributes, for a wedge or vertex; there is half of one for each corner of a triangle mesh at most.
double attribute_bytes(const Mesh& mesh) {
    double bytes = 0;
    for (const auto& a : mesh.attributes)
        bytes += std::visit([](const auto& data) { return sizeof(data.front()); }, a.data) * a.components;
    return bytes;
}

void refuse_giants(const Mesh& mesh, double corners, const char* hint) {
    if (corners > corner_limit)
        throw Error(
            ErrorKind::limit, "E-LIMIT",
            fmt::format("split: the result would have about {:.3g} corners, at most {:.0f} are possible",
                        corners, corner_limit),
            hint);
    require_memory((bytes_per_corner + attribute_bytes(mesh) / 2) * corners,
                   fmt::format("split: a result of {:.3g} corners", corners), hint);
}

constexpr const char* coarser = "use fewer passes, a coarser grid or a longer max_edge";

/// Passes over all faces, as many as the settings allow and the targets need.
SplitResult repeated(const Mesh& mesh, const SplitSettings& settings) {
    SplitResult result;
    const Mesh* from = &mesh;
    while (result.passes < settings.passes) {
        if (settings.max_edge > 0 && facet_shape(*from, settings.to_world).longest_edge <= settings.max_edge)
            break;
        Census next(*from);
        next.pass(settings.method, settings.grid);
        if (settings.faces > 0 && next.faces() > static_cast<double>(settings.faces)) {
            result.budget_reached = true;
            break;
        }
        if (settings.min_angle > 0) refuse_giants(*from, next.corners(), coarser);
        check_polygons(*from, settings.method);
        Mesh finer = split_once(*from, settings, result.passes, result.fates);
        if (settings.min_angle > 0 && finer.face_count() == 0) break; // none is narrow
        result.mesh = std::move(finer);
        from = &result.mesh;
        ++result.passes;
    }
    if (from == &mesh) result.mesh = mesh;
    result.added = result.mesh.face_count() - mesh.face_count();
    return result;
}

} // namespace

bool is_smooth(SplitMethod method) { return method >= SplitMethod::loop; }

const char* spelled(SplitMethod method) {
    constexpr const char* names[] = {"midpoint", "bisect", "notch", "centroid",  "grid",
                                     "quads",    "halve",  "fan",   "varignon",  "core",
                                     "diagonal", "loop",   "sqrt3", "butterfly", "catmull-clark"};
    return names[static_cast<std::size_t>(method)];
}

void check_split_targets(const SplitSettings& s) {
    const auto refuse = [&](const char* target, const char* knows) {
        throw Error(ErrorKind::usage, "E-TARGET",
                    fmt::format("split: {} cannot reach the target {}", spelled(s.method), target),
                    fmt::format("use {}", knows));
    };
    if (s.max_edge > 0 && s.method != SplitMethod::bisect && !halves_edges(s.method))
        refuse("max_edge", "bisect, midpoint, quads, loop, butterfly or catmull-clark");
    if (s.min_angle > 0 && s.method != SplitMethod::bisect && s.method != SplitMethod::notch)
        refuse("min_angle", "bisect or notch");
    if (s.min_angle > 0 && (s.max_edge > 0 || s.faces > 0))
        throw Error(ErrorKind::usage, "E-TARGET", "split: min_angle goes with no other target",
                    "use two split stages");
}

double split_corner_estimate(const Mesh& mesh, const SplitSettings& settings) {
    const bool refines = settings.method == SplitMethod::bisect && mesh.all_triangles();
    if (refines && (settings.max_edge > 0 || settings.faces > 0)) {
        double faces = settings.max_edge > 0 ? refined_estimate(mesh, settings) : 1e300;
        if (settings.faces > 0) faces = std::min(faces, static_cast<double>(settings.faces));
        return 3 * std::max(faces, static_cast<double>(mesh.face_count()));
    }
    Census census(mesh);
    double longest = settings.max_edge > 0 ? facet_shape(mesh, settings.to_world).longest_edge : 0;
    for (int pass = 0; pass < settings.passes && census.corners() <= 1e18; ++pass) {
        if (settings.max_edge > 0 && longest <= settings.max_edge) break;
        Census next = census;
        next.pass(settings.method, settings.grid);
        if (settings.faces > 0 && next.faces() > static_cast<double>(settings.faces)) break;
        census = next;
        longest /= 2;
    }
    return census.corners();
}

SplitResult split(const Mesh& mesh, const SplitSettings& settings) {
    check_split_targets(settings);
    check_polygons(mesh, settings.method);
    if (settings.min_angle <= 0) refuse_giants(mesh, split_corner_estimate(mesh, settings), coarser);
    if (is_smooth(settings.method) && settings.passes > 0) require_manifold(mesh, settings.method);
    if (settings.method == SplitMethod::bisect && (settings.max_edge > 0 || settings.faces > 0))
        return refine(mesh, settings);
    return repeated(mesh, settings);
}

SplitResult grid_split(const Mesh& mesh, int n) {
    SplitSettings settings;
    settings.method = SplitMethod::grid, settings.grid = n;
    return split(mesh, settings);
}

} // namespace facetmill
