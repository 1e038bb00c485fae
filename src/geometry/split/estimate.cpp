#include "geometry/split/estimate.hpp"

#include "base/error.hpp"
#include "mesh/topology.hpp"
#include "parallel/memory.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

constexpr double corner_limit = 2147483648.0; ///< 2^31
/// Memory at the peak: the result, the edges of the input, and the provenance.
constexpr double bytes_per_corner = 36;

/// The approximate number of triangles after refining to max_edge. A triangle with edges of this length has
/// at most sqrt(3) / 4 of its square as area, and cuts leave smaller triangles.
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

/// Bytes of all attributes for each wedge or vertex. A triangle mesh has at most half a vertex per corner.
double attribute_bytes(const Mesh& mesh) {
    double bytes = 0;
    for (const auto& a : mesh.attributes)
        bytes += std::visit([](const auto& data) { return sizeof(data.front()); }, a.data) * a.components;
    return bytes;
}

/// The longest possible edge after one pass that halves all edges: half of the longest, or from the middle
/// of an edge of a larger face to its centroid. In triangles and quads the latter is not longer.
double longest_after_first(const Mesh& mesh, const SplitSettings& s, double longest) {
    if (mesh.all_triangles()) return longest / 2;
    return parallel_reduce(
        mesh.face_count(), longest / 2,
        [&](std::size_t begin, std::size_t end) {
            double most = 0;
            for (auto f = static_cast<Index>(begin); f < end; ++f) {
                if (mesh.face_size(f) <= 4) continue;
                const Vec3 centre = corner_mean(mesh, f);
                for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
                    const Vec3 middle = (mesh.point(c) + mesh.point(next_corner(mesh, f, c))) / 2;
                    most = std::max(most, length(s.to_world.vector(middle - centre)));
                }
            }
            return most;
        },
        [](double a, double b) { return std::max(a, b); });
}

} // namespace

SplitCensus::SplitCensus(const Mesh& mesh) {
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
        else {
            ++larger;
            larger_corners += n;
        }
    }
}

void SplitCensus::pass(SplitMethod method, double n) {
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
    case SplitMethod::notch: // the worst case is 4 triangles, which have more corners than a triangle and a
                             // quad
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

void refuse_giant_split(const Mesh& mesh, double corners, const SplitWords& words) {
    if (corners > corner_limit)
        throw Error(
            ErrorKind::limit, "E-LIMIT",
            fmt::format("{}: the result would have about {:.3g} corners, but at most {:.0f} are possible",
                        words.subject, corners, corner_limit),
            words.fewer);
    const double bytes = (bytes_per_corner + attribute_bytes(mesh) / 2) * corners;
    if (is_much_memory(bytes))
        require_memory(bytes, fmt::format("{}: a result of {:.3g} corners", words.subject, corners),
                       words.fewer);
}

double split_corner_estimate(const Mesh& mesh, const SplitSettings& settings) {
    const bool refines = settings.method == SplitMethod::bisect && mesh.all_triangles();
    SplitCensus census(mesh);
    if (refines && (settings.max_edge > 0 || settings.max_faces > 0)) {
        double faces = settings.max_edge > 0 ? refined_estimate(mesh, settings) : 1e300;
        if (settings.max_faces > 0) faces = std::min(faces, static_cast<double>(settings.max_faces));
        for (int pass = 0; pass < settings.passes && census.faces() < faces; ++pass)
            census.pass(settings.method, settings.grid);
        return 3 * std::max(std::min(faces, census.faces()), static_cast<double>(mesh.face_count()));
    }
    double longest = settings.max_edge > 0 ? facet_shape(mesh, settings.to_world).longest_edge : 0;
    for (int pass = 0; pass < settings.passes && census.corners() <= 1e18; ++pass) {
        if (settings.max_edge > 0 && longest <= settings.max_edge) break;
        SplitCensus next = census;
        next.pass(settings.method, settings.grid);
        if (settings.max_faces > 0 && next.faces() > static_cast<double>(settings.max_faces)) break;
        census = next;
        if (settings.max_edge > 0)
            longest = pass == 0 ? longest_after_first(mesh, settings, longest) : longest / 2;
    }
    return census.corners();
}

} // namespace facetmill
