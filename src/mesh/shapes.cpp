#include "mesh/shapes.hpp"

#include "base/math/portable_math.hpp"
#include "mesh/topology.hpp"

#include <initializer_list>

namespace facetmill::shapes {

namespace {

Mesh from(std::vector<Vec3> positions, std::initializer_list<std::initializer_list<Index>> faces) {
    Mesh mesh;
    mesh.positions = std::move(positions);
    for (const auto& face : faces) add_face(mesh, {face.begin(), face.size()});
    return mesh;
}

/// The corners of the unit cube, x fastest.
std::vector<Vec3> cube_corners() {
    return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
}

constexpr Index cube_quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

void add_triangle(Mesh& mesh, Index a, Index b, Index c) {
    mesh.corners.insert(mesh.corners.end(), {a, b, c});
}

void add_quad_as_triangles(Mesh& mesh, Index a, Index b, Index c, Index d) {
    add_triangle(mesh, a, b, c);
    add_triangle(mesh, a, c, d);
}

} // namespace

Mesh tetrahedron() {
    return from({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
}

Mesh quad_cube() {
    Mesh mesh;
    mesh.positions = cube_corners();
    for (const auto& q : cube_quads) add_face(mesh, q);
    return mesh;
}

Mesh cube() {
    Mesh mesh;
    mesh.positions = cube_corners();
    for (const auto& q : cube_quads) add_quad_as_triangles(mesh, q[0], q[1], q[2], q[3]);
    return mesh;
}

Mesh uv_cube() {
    Mesh mesh;
    mesh.positions = cube_corners();
    std::vector<float> uvs, normals;
    for (const auto& q : cube_quads) {
        const auto w = static_cast<Index>(mesh.wedge_vertex.size());
        mesh.wedge_vertex.insert(mesh.wedge_vertex.end(), {q[0], q[1], q[2], q[3]});
        add_quad_as_triangles(mesh, w, w + 1, w + 2, w + 3);
        uvs.insert(uvs.end(), {0, 0, 1, 0, 1, 1, 0, 1});
        const Vec3& p = mesh.positions[q[0]];
        const Vec3 n = cross(mesh.positions[q[1]] - p, mesh.positions[q[2]] - p);
        for (int i = 0; i < 4; ++i)
            for (std::size_t k = 0; k < 3; ++k) normals.push_back(static_cast<float>(n[k]));
    }
    mesh.attributes.push_back({"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::move(uvs)});
    mesh.attributes.push_back({"NORMAL", Domain::wedge, Role::normal, 3, false, std::move(normals)});
    return mesh;
}

Mesh octahedron() {
    return from({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

namespace {

Mesh icosahedron() {
    const double g = (1 + std::sqrt(5.0)) / 2;
    Mesh mesh = from({{-1, g, 0},
                      {1, g, 0},
                      {-1, -g, 0},
                      {1, -g, 0},
                      {0, -1, g},
                      {0, 1, g},
                      {0, -1, -g},
                      {0, 1, -g},
                      {g, 0, -1},
                      {g, 0, 1},
                      {-g, 0, -1},
                      {-g, 0, 1}},
                     {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}});
    for (auto& p : mesh.positions) p = normalised(p);
    return mesh;
}

/// Divides every triangle into four, with the new points on the unit sphere.
Mesh refined(const Mesh& mesh) {
    const auto edges = build_edges(mesh);
    const auto n = static_cast<Index>(mesh.vertex_count());
    Mesh fine;
    fine.positions = mesh.positions;
    for (const auto& e : edges.edges)
        fine.positions.push_back(normalised(mesh.positions[e.low] + mesh.positions[e.high]));
    for (Index c = 0; c < mesh.corner_count(); c += 3) {
        const Index v[3] = {mesh.corners[c], mesh.corners[c + 1], mesh.corners[c + 2]};
        const Index m[3] = {n + edges.corner_edge[c], n + edges.corner_edge[c + 1],
                            n + edges.corner_edge[c + 2]};
        add_triangle(fine, v[0], m[0], m[2]);
        add_triangle(fine, m[0], v[1], m[1]);
        add_triangle(fine, m[2], m[1], v[2]);
        add_triangle(fine, m[0], m[1], m[2]);
    }
    return fine;
}

} // namespace

Mesh icosphere(int levels) {
    Mesh mesh = icosahedron();
    for (int i = 0; i < levels; ++i) mesh = refined(mesh);
    return mesh;
}

Mesh torus(int segments, int rings, double major, double minor) {
    Mesh mesh;
    for (int i = 0; i < segments; ++i)
        for (int j = 0; j < rings; ++j) {
            const double a = 2 * pi * i / segments, b = 2 * pi * j / rings, r = major + minor * cosine(b);
            mesh.positions.push_back({r * cosine(a), r * sine(a), minor * sine(b)});
        }
    const auto at = [&](int i, int j) { return static_cast<Index>(i % segments * rings + j % rings); };
    for (int i = 0; i < segments; ++i)
        for (int j = 0; j < rings; ++j)
            add_quad_as_triangles(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    return mesh;
}

Mesh grid(int columns, int rows) {
    Mesh mesh;
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x) mesh.positions.push_back({double(x), double(y), 0});
    const auto at = [&](int x, int y) { return static_cast<Index>(y * (columns + 1) + x); };
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x)
            add_quad_as_triangles(mesh, at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1));
    return mesh;
}

Mesh open_cone(int segments) {
    Mesh mesh;
    mesh.positions.push_back({0, 0, 1});
    for (int i = 0; i < segments; ++i)
        mesh.positions.push_back({cosine(2 * pi * i / segments), sine(2 * pi * i / segments), 0});
    for (int i = 0; i < segments; ++i)
        add_triangle(mesh, 0, static_cast<Index>(1 + i), static_cast<Index>(1 + (i + 1) % segments));
    return mesh;
}

Mesh bowtie() {
    return from({{0, 0, 0}, {-1, -1, 0}, {-1, 1, 0}, {1, -1, 0}, {1, 1, 0}}, {{0, 2, 1}, {0, 3, 4}});
}

Mesh fan3() {
    return from({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}},
                {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
}

Mesh hourglass() {
    return from({{0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {-1, -1, 1}, {1, 0, -1}, {0, 1, -1}, {-1, -1, -1}},
                {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}});
}

Mesh moebius(int segments) {
    Mesh mesh;
    for (int i = 0; i < segments; ++i) {
        const double a = 2 * pi * i / segments;
        for (const double side : {-0.3, 0.3}) {
            const double r = 1 + side * cosine(a / 2);
            mesh.positions.push_back({r * cosine(a), r * sine(a), side * sine(a / 2)});
        }
    }
    const auto n = static_cast<Index>(segments);
    for (Index i = 0; i < n; ++i) { // after one turn the sides are exchanged
        const Index a = 2 * i, b = a + 1, c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? a + 3 : 0;
        const Index quad[] = {a, c, d, b};
        add_face(mesh, quad);
    }
    return mesh;
}

Mesh crossing() {
    return from({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -1}, {0.5, 0.5, 1}, {3, 3, 0}},
                {{0, 1, 2}, {3, 4, 5}});
}

Mesh folded_quad() { return from({{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 0, 3}}); }

} // namespace facetmill::shapes
