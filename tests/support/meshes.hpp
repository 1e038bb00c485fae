#pragma once
// Random meshes for property tests: the same for the same seed, on every machine.

#include "base/math/portable_math.hpp"
#include "base/math/random.hpp"
#include "mesh/provenance.hpp"
#include "mesh/shapes.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace facetmill::test {

/// A number in (low, high) for a seed and a key.
inline double between(double low, double high, std::uint64_t seed, std::uint64_t key) {
    return low + (high - low) * uniform(hashed(seed, key));
}

/// A point in the cube from -size to size, for a seed and a key.
inline Vec3 random_point(double size, std::uint64_t seed, std::uint64_t key) {
    return {between(-size, size, seed, 3 * key), between(-size, size, seed, 3 * key + 1),
            between(-size, size, seed, 3 * key + 2)};
}

inline Mesh moved(Mesh mesh, const Vec3& by) {
    for (Vec3& p : mesh.positions) p += by;
    return mesh;
}

/// Rounds every coordinate down to a multiple of step, so that vertices and faces coincide.
inline Mesh snapped(Mesh mesh, double step) {
    for (Vec3& p : mesh.positions)
        for (std::size_t i = 0; i < 3; ++i) p[i] = std::floor(p[i] / step) * step;
    return mesh;
}

/// Moves every vertex along its direction from the origin by up to amount, relative to its distance.
inline Mesh with_radial_noise(Mesh mesh, double amount, std::uint64_t seed) {
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        mesh.positions[v] *= 1 + between(-amount, amount, seed, v);
    return mesh;
}

/// Moves every vertex by up to amount along each axis.
inline Mesh with_noise(Mesh mesh, double amount, std::uint64_t seed) {
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        for (std::size_t i = 0; i < 3; ++i) mesh.positions[v][i] += between(-amount, amount, seed, 3 * v + i);
    return mesh;
}

/// Closed, genus 0, without self-intersections because it is star-shaped, 20 * 4^levels faces.
inline Mesh noisy_icosphere(int levels, double amount, std::uint64_t seed) {
    return with_radial_noise(shapes::icosphere(levels), amount, seed);
}

/// Closed, genus 1. Has no self-intersections if the amount is small compared with its cells.
inline Mesh noisy_torus(int segments, int rings, double amount, std::uint64_t seed) {
    return test::with_noise(shapes::torus(segments, rings), amount, seed);
}

/// The same surface with wedges: TEXCOORD_0 with seams, and a smooth NORMAL. Each of `charts` slabs along x
/// is a separate chart, so that vertices between slabs have several wedges.
inline Mesh with_uv_seams(const Mesh& mesh, int charts = 3) {
    const Box box = mesh.bounds();
    const auto chart_of = [&](Index f) {
        Vec3 sum;
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) sum += mesh.point(c);
        const double t = (sum.x / mesh.face_size(f) - box.min.x) / (box.extent().x > 0 ? box.extent().x : 1);
        return std::min(charts - 1, static_cast<int>(t * charts));
    };
    Mesh seamed;
    seamed.positions = mesh.positions;
    seamed.face_offsets = mesh.face_offsets;
    std::map<std::pair<Index, int>, Index> wedges;
    std::vector<float> uvs, normals;
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
            const Index v = mesh.vertex(c);
            const auto [at, added] = wedges.try_emplace({v, chart_of(f)}, static_cast<Index>(wedges.size()));
            seamed.corners.push_back(at->second);
            if (!added) continue;
            seamed.wedge_vertex.push_back(v);
            const Vec3& p = mesh.positions[v];
            uvs.push_back(static_cast<float>(p.y + 10 * at->first.second));
            uvs.push_back(static_cast<float>(p.z));
            const Vec3 n = normalised(p);
            normals.insert(normals.end(),
                           {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)});
        }
    seamed.attributes.push_back({"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::move(uvs)});
    seamed.attributes.push_back({"NORMAL", Domain::wedge, Role::normal, 3, false, std::move(normals)});
    return seamed;
}

/// Every triangle has its own vertices, as in STL. Welding restores the mesh.
inline Mesh torn_apart(const Mesh& mesh) {
    Mesh soup;
    for (Index c = 0; c < mesh.corner_count(); ++c) {
        soup.corners.push_back(c);
        soup.positions.push_back(mesh.point(c));
    }
    return soup;
}

/// Triangles of random size at random positions, without shared vertices: open, intersecting.
inline Mesh random_triangles(std::size_t count, double size, std::uint64_t seed) {
    Mesh mesh;
    for (std::size_t t = 0; t < count; ++t) {
        Vec3 centre;
        for (std::size_t i = 0; i < 3; ++i) centre[i] = between(0, 1, seed, 20 * t + i);
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3 p = centre;
            for (std::size_t i = 0; i < 3; ++i) p[i] += between(-size, size, seed, 20 * t + 3 + 3 * k + i);
            mesh.corners.push_back(static_cast<Index>(mesh.positions.size()));
            mesh.positions.push_back(p);
        }
    }
    return mesh;
}

/// The six sides of a cube as grids of n by n, which touch and share no vertices.
inline Mesh touching_sides(int n) {
    Mesh mesh;
    const Mesh side = shapes::grid(n, n);
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const bool far : {false, true}) {
            Transform t;
            for (auto& row : t.m) row[0] = row[1] = row[2] = row[3] = 0;
            const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
            t.m[far ? u : v][0] = t.m[far ? v : u][1] = 1;
            t.m[axis][2] = far ? 1 : -1;
            t.m[axis][3] = far ? n : 0;
            Mesh one = side;
            apply(one, t);
            append(mesh, one);
        }
    return mesh;
}

/// The solid between a grid's heights and the plane z = 0.
inline Mesh solid_below(Mesh top) {
    const auto n = static_cast<Index>(top.vertex_count());
    const std::vector<BoundaryEdge> border = boundary_edges(top);
    const std::vector<Index> corners = top.corners;
    for (Index v = 0; v < n; ++v) top.positions.push_back({top.positions[v].x, top.positions[v].y, 0});
    for (std::size_t c = 0; c < corners.size(); c += 3)
        top.corners.insert(top.corners.end(), {n + corners[c], n + corners[c + 2], n + corners[c + 1]});
    for (const auto& e : border)
        top.corners.insert(top.corners.end(), {e.to, e.from, n + e.from, e.to, n + e.from, n + e.to});
    return top;
}

} // namespace facetmill::test
