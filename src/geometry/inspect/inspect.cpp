#include "geometry/inspect/inspect.hpp"

#include "base/parallel.hpp"
#include "geometry/inspect/evidence.hpp"
#include "geometry/inspect/connectivity.hpp"
#include "mesh/power_scale.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <cstdlib>

namespace facetmill {

namespace {

/// Sums over faces, by chunks in order.
struct FaceSums {
    std::int64_t triangles = 0, degenerate = 0, repeating = 0;
    double area = 0, volume = 0; ///< volume: six times
    void add(const FaceSums& b) {
        triangles += b.triangles, degenerate += b.degenerate, repeating += b.repeating;
        area += b.area, volume += b.volume;
    }
};

bool repeats_a_vertex(const Mesh& mesh, Index f) {
    const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
    for (Index a = begin; a < end; ++a)
        for (Index b = begin; b < a; ++b)
            if (mesh.vertex(a) == mesh.vertex(b)) return true;
    return false;
}

/// Adds the triangle p, a, b of a polygon to its area vector and to the volume, seen from origin.
void add_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& origin, Vec3& area,
                  double& volume) {
    const Vec3 product = cross(a - p, b - p);
    area += product;
    volume += dot(p - origin, product);
}

FaceSums face_sums(const Mesh& mesh, const std::vector<Vec3>& positions, const Vec3& origin) {
    return parallel_reduce(
        mesh.face_count(), FaceSums{},
        [&](std::size_t first, std::size_t last) {
            FaceSums sums;
            for (std::size_t i = first; i < last; ++i) {
                const auto f = static_cast<Index>(i);
                const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
                Vec3 area;
                for (Index c = begin + 1; c + 1 < end; ++c)
                    add_triangle(positions[mesh.vertex(begin)], positions[mesh.vertex(c)],
                                 positions[mesh.vertex(c + 1)], origin, area, sums.volume);
                sums.area += safe_length(area) / 2;
                sums.triangles += end - begin == 3;
                sums.degenerate += is_degenerate(mesh, f);
                sums.repeating += end - begin == 3 && repeats_a_vertex(mesh, f);
            }
            return sums;
        },
        [](FaceSums a, const FaceSums& b) {
            a.add(b);
            return a;
        });
}

/// The same for boxes of any size, area and volume rounded once more.
FaceSums far_face_sums(const Mesh& mesh, const std::vector<Vec3>& positions, const Box& box) {
    const PowerScale even = even_scale(box), axes = axis_scale(box);
    const auto sums_of = [&](const PowerScale& scale) {
        const Vec3 origin = box.empty() ? Vec3{} : (scale(box.min) + scale(box.max)) * 0.5;
        return scale.none() ? face_sums(mesh, positions, origin) : face_sums(mesh, scale(positions), origin);
    };
    FaceSums sums = sums_of(even);
    if (!even.none()) sums.area = unscaled(sums.area, 2 * even.powers[0]);
    if (!axes.none()) sums.volume = unscaled(sums_of(axes).volume, axes.volume());
    return sums;
}

/// positions: the mesh's, or where a transform puts them; one that mirrors turns the faces round, as glTF has
/// it.
Properties inspect_placed(const Mesh& mesh, const std::vector<Vec3>& positions, bool mirrored,
                          const InspectSettings& settings) {
    Properties p;
    p.vertices = static_cast<std::int64_t>(mesh.vertex_count());
    p.wedges = static_cast<std::int64_t>(mesh.wedge_count());
    p.faces = static_cast<std::int64_t>(mesh.face_count());
    p.bounds = box_of(positions);
    const FaceSums sums = far_face_sums(mesh, positions, p.bounds);
    const LinkCounts links = count_links(mesh);
    p.triangles = sums.triangles;
    p.degenerate_faces = sums.degenerate;
    p.area = sums.area;
    p.edges = links.edges;
    p.boundary_edges = links.boundary_edges;
    p.boundary_loops = links.boundary_loops;
    p.isolated_vertices = links.isolated_vertices;
    p.closed = links.uncancelled_edges == 0;
    p.edge_manifold = links.crowded_edges == 0;
    p.vertex_manifold = links.non_manifold_vertices == 0;
    p.oriented = links.disagreeing_edges == 0;
    // Triangles of three different vertices are compared where they meet; all else by the hash of its
    // vertices.
    p.duplicate_faces = mesh.all_triangles() && sums.repeating == 0
                            ? links.duplicate_triangles
                            : static_cast<std::int64_t>(duplicate_faces(mesh).size());
    p.components = static_cast<std::int64_t>(component_count(mesh));
    p.euler = p.vertices - p.isolated_vertices - p.edges + p.faces;
    if (p.closed) p.volume = (mirrored ? -sums.volume : sums.volume) / 6;
    if (p.closed && p.edge_manifold && p.vertex_manifold && p.oriented) p.genus = p.components - p.euler / 2;
    if (settings.self_intersections) {
        const auto found = find_self_intersections(mesh, {.limit = 0, .apart = true});
        p.self_intersections = static_cast<std::int64_t>(found.count);
        p.touching = static_cast<std::int64_t>(found.touching);
    }
    return p;
}

template <class T>
void add_optional(std::optional<T>& sum, const std::optional<T>& x) {
    if (sum && x)
        *sum += *x;
    else
        sum.reset();
}

/// Where both apply, one value of two parts; where only one does, its own.
void add_qualities(Properties& sum, const Properties& p) {
    for (std::size_t q = 0; q < quality_count; ++q) {
        auto& a = sum.qualities[q];
        const auto& b = p.qualities[q];
        if (!b) continue;
        switch (info_of(static_cast<Quality>(q)).join) {
        case Join::sum:
            a = a.value_or(0) + *b;
            break;
        case Join::most:
            a = a ? std::max(*a, *b) : *b;
            break;
        default: // a truth holds when all do: the least of 0 and 1
            a = a ? std::min(*a, *b) : *b;
        }
    }
}

/// local: the mesh as it is, whose orientation counts, mirrored by its node or not.
void measure_qualities(Properties& p, const Mesh& world, const Mesh& local, const InspectSettings& settings) {
    for (std::size_t q = 0; q < quality_count; ++q)
        if (settings.qualities >> q & 1u) {
            const auto quality = static_cast<Quality>(q);
            p.qualities[q] = measure(quality == Quality::outward ? local : world, quality);
        }
}

void add(Properties& sum, const Properties& p) {
    sum.vertices += p.vertices, sum.wedges += p.wedges, sum.edges += p.edges;
    sum.faces += p.faces, sum.triangles += p.triangles, sum.components += p.components, sum.euler += p.euler;
    sum.boundary_loops += p.boundary_loops, sum.boundary_edges += p.boundary_edges;
    sum.degenerate_faces += p.degenerate_faces, sum.duplicate_faces += p.duplicate_faces;
    sum.isolated_vertices += p.isolated_vertices;
    sum.closed = sum.closed && p.closed, sum.oriented = sum.oriented && p.oriented;
    sum.edge_manifold = sum.edge_manifold && p.edge_manifold;
    sum.vertex_manifold = sum.vertex_manifold && p.vertex_manifold;
    sum.area += p.area;
    add_optional(sum.genus, p.genus);
    add_optional(sum.volume, p.volume);
    add_optional(sum.self_intersections, p.self_intersections);
    add_optional(sum.touching, p.touching);
    sum.bounds.add(p.bounds);
    add_qualities(sum, p);
}

} // namespace

Properties inspect(const Mesh& mesh, const InspectSettings& settings) {
    Properties p = inspect_placed(mesh, mesh.positions, false, settings);
    measure_qualities(p, mesh, mesh, settings);
    return p;
}

Properties inspect(const Part& part, const InspectSettings& settings) {
    if (part.transform.identity()) return inspect(part.mesh, settings);
    std::vector<Vec3> world(part.mesh.vertex_count());
    parallel_for(world.size(),
                 [&](std::size_t v) { world[v] = part.transform.point(part.mesh.positions[v]); });
    Properties p = inspect_placed(part.mesh, world, part.transform.determinant() < 0, settings);
    if (settings.qualities == 0) return p;
    Mesh placed = part.mesh;
    placed.positions = std::move(world);
    measure_qualities(p, placed, part.mesh, settings);
    return p;
}

Properties inspect(const Scene& scene, const InspectSettings& settings) {
    Properties sum;
    sum.parts = static_cast<std::int64_t>(scene.parts.size());
    sum.materials = static_cast<std::int64_t>(scene.materials.size());
    sum.unit = scene.unit, sum.up = scene.up;
    sum.genus = 0;
    sum.volume = 0;
    if (settings.self_intersections) sum.self_intersections = sum.touching = 0;
    for (const Part& part : scene.parts) add(sum, inspect(part, settings));
    return sum;
}

} // namespace facetmill
