#include "geometry/unwrap/surface.hpp"

#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

namespace facetmill::unwrap_room {

namespace {

/// The least height of a triangle, as a share of its longest side: lower triangles are flattened with this
/// height, so that they keep an area in the texture.
constexpr double least_height = 1e-3;

bool repeats_a_vertex(const UnwrapSurface& s, Index f) {
    const Index a = s.corner_vertex[3 * f], b = s.corner_vertex[3 * f + 1], c = s.corner_vertex[3 * f + 2];
    return a == b || b == c || c == a;
}

void add_positions(UnwrapSurface& s, std::span<const UnwrapInput> inputs) {
    std::size_t vertices = 0, corners = 0;
    for (const UnwrapInput& in : inputs) {
        vertices += in.mesh->vertex_count();
        corners += in.mesh->corner_count();
    }
    resize_large(s.positions, vertices);
    resize_large(s.corner_vertex, corners);
    resize_large(s.twin, corners, none);
    std::size_t vertex = 0, corner = 0;
    s.mesh_begin.push_back(0);
    for (const UnwrapInput& in : inputs) {
        const Mesh& mesh = *in.mesh;
        parallel_for(mesh.vertex_count(), [&](std::size_t v) {
            const Vec3 p = in.to_world.point(mesh.positions[v]);
            s.positions[vertex + v] = is_finite(p) ? p : Vec3{};
        });
        parallel_for(mesh.corner_count(), [&](std::size_t c) {
            s.corner_vertex[corner + c] = static_cast<Index>(vertex + mesh.vertex(static_cast<Index>(c)));
        });
        vertex += mesh.vertex_count();
        corner += mesh.corner_count();
        s.mesh_begin.push_back(static_cast<Index>(corner / 3));
    }
    // Halves first, because sums of huge coordinates may overflow.
    const Box box = box_of(s.positions);
    const Vec3 centre = box.empty() ? Vec3{} : box.min * 0.5 + box.max * 0.5;
    const Vec3 half = box.empty() ? Vec3{} : box.max * 0.5 - box.min * 0.5;
    const double longest = std::max({half.x, half.y, half.z}), factor = 1 / longest;
    if (longest > 0 && std::isfinite(factor)) s.unit = longest;
    parallel_for(vertices, [&](std::size_t v) { s.positions[v] = (s.positions[v] - centre) * (1 / s.unit); });
}

/// Finds the neighbours over edges of exactly two faces that agree in orientation.
void add_twins(UnwrapSurface& s, const Mesh& mesh, Index first_face) {
    const EdgeTable edges = build_edges(mesh);
    const Index first = 3 * first_face;
    parallel_for(edges.size(), [&](std::size_t e) {
        const auto corners = edges.corners_of(static_cast<Index>(e));
        if (corners.size() != 2) return;
        const Index a = first + corners[0], b = first + corners[1];
        if (a / 3 == b / 3 || s.corner_vertex[a] == s.corner_vertex[b]) return;
        if (repeats_a_vertex(s, a / 3) || repeats_a_vertex(s, b / 3)) return;
        s.twin[a] = b;
        s.twin[b] = a;
    });
}

FlatShape shape_of(const Vec3& a, const Vec3& b, const Vec3& c, double unit, bool& thin) {
    FlatShape shape;
    const Vec3 u = b - a, v = c - a;
    const double longest = std::sqrt(std::max({dot(u, u), dot(v, v), dot(c - b, c - b)}));
    const double l = length(u), least = std::max(least_height * longest, least_height * unit);
    thin = l < least;
    shape.length = std::max(l, least);
    shape.x = l > 0 ? dot(u, v) / l : 0;
    const double height = l > 0 ? length(cross(u, v)) / l : length(v);
    thin = thin || height < least;
    shape.height = std::max(height, least);
    return shape;
}

} // namespace

UnwrapSurface surface_of(std::span<const UnwrapInput> inputs) {
    UnwrapSurface s;
    add_positions(s, inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) add_twins(s, *inputs[i].mesh, s.mesh_begin[i]);
    const std::size_t faces = s.corner_vertex.size() / 3;
    resize_large(s.area_vectors, faces);
    resize_large(s.shapes, faces);
    resize_large(s.is_thin, faces);
    const double perimeters = parallel_reduce(
        faces, 0.0,
        [&](std::size_t begin, std::size_t end) {
            double sum = 0;
            for (std::size_t c = 3 * begin; c < 3 * end; ++c) sum += s.edge_length(static_cast<Index>(c));
            return sum;
        },
        std::plus<>());
    const double mean = faces > 0 ? perimeters / static_cast<double>(3 * faces) : 1;
    s.edge_unit = mean > 0 ? mean : 1;
    parallel_for(faces, [&](std::size_t f) {
        const auto c = static_cast<Index>(3 * f);
        const Vec3 &p = s.point(c), &q = s.point(c + 1), &r = s.point(c + 2);
        bool thin = false;
        s.area_vectors[f] = cross(q - p, r - p);
        s.shapes[f] = shape_of(p, q, r, s.edge_unit, thin);
        s.is_thin[f] = thin;
    });
    return s;
}

} // namespace facetmill::unwrap_room
