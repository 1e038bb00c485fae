#include "support/catch.hpp"

#include "base/math/random.hpp"
#include "geometry/inspect/connectivity.hpp"
#include "mesh/shapes.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>

using namespace facetmill;

namespace {

/// A sphere with some faces reversed, doubled or missing, and some vertices merged.
Mesh faulty_sphere(std::uint64_t seed, std::uint64_t faults) {
    const Mesh sphere = shapes::icosphere(2);
    Mesh mesh;
    mesh.positions = sphere.positions;
    const auto fault = [&](std::uint64_t what, std::uint64_t of) {
        return hashed(hashed(seed, what), of) % 1000 < faults;
    };
    for (Index f = 0; f < sphere.face_count(); ++f) {
        std::array<Index, 3> t;
        for (Index k = 0; k < 3; ++k) {
            t[k] = sphere.vertex(3 * f + k);
            if (fault(0, t[k])) t[k] = static_cast<Index>(hashed(seed, t[k]) % mesh.vertex_count());
        }
        if (fault(1, f)) continue;
        if (fault(2, f)) std::swap(t[0], t[1]);
        for (int copies = fault(3, f) ? 2 : 1; copies > 0; --copies) {
            mesh.corners.insert(mesh.corners.end(), t.begin(), t.end());
            if (fault(4, f)) std::swap(t[1], t[2]);
        }
    }
    return mesh;
}

using Wings = std::vector<std::array<Index, 2>>; ///< the vertices before and after, of each face at a vertex

/// The number of groups of wings connected by edges.
std::size_t fans(Index v, const Wings& wings) {
    std::vector<std::size_t> fan(wings.size());
    std::size_t count = wings.size();
    for (std::size_t i = 0; i < fan.size(); ++i) fan[i] = i;
    for (std::size_t i = 0; i < fan.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            for (const Index a : wings[i])
                if (a != v && std::count(wings[j].begin(), wings[j].end(), a) > 0 && fan[i] != fan[j]) {
                    std::replace(fan.begin(), fan.end(), std::size_t{fan[i]}, std::size_t{fan[j]});
                    --count;
                }
    return count;
}

/// The same, by testing each edge, each vertex and each triangle. Ignores loops.
Connectivity counted_one_by_one(const Mesh& mesh) {
    std::map<std::array<Index, 2>, std::array<int, 2>> edges; // uses upwards and downwards
    std::map<std::array<Index, 3>, int> triangles;
    std::vector<Wings> wings(mesh.vertex_count());
    Connectivity n;
    for (Index c = 0; c < mesh.corners.size(); ++c) {
        const Index a = mesh.corners[c], b = mesh.corners[c / 3 * 3 + (c + 1) % 3],
                    before = mesh.corners[c / 3 * 3 + (c + 2) % 3];
        if (a != b) ++edges[{std::min(a, b), std::max(a, b)}][a < b ? 0 : 1];
        wings[a].push_back({before, b});
        std::array<Index, 3> t{a, b, before};
        std::sort(t.begin(), t.end());
        if (c % 3 == 0 && t[0] < t[1] && t[1] < t[2] && triangles[t]++ > 0) ++n.duplicate_triangles;
    }
    for (const auto& [edge, uses] : edges) {
        ++n.edges;
        n.boundary_edges += uses[0] + uses[1] == 1;
        n.crowded_edges += uses[0] + uses[1] > 2;
        n.uncancelled_edges += uses[0] != uses[1];
        n.disagreeing_edges += std::abs(uses[0] - uses[1]) > 1;
    }
    for (Index v = 0; v < wings.size(); ++v) {
        n.isolated_vertices += wings[v].empty();
        n.non_manifold_vertices += fans(v, wings[v]) > 1;
    }
    return n;
}

} // namespace

TEST_CASE("connectivity is what a look at each edge and vertex gives, with faults of all kinds",
          "[geometry]") {
    for (const std::uint64_t faults : {0, 3, 30, 300})
        for (std::uint64_t seed = 0; seed < 8; ++seed) {
            const Mesh mesh = faulty_sphere(seed, faults);
            const Connectivity found = connectivity_of(mesh), wanted = counted_one_by_one(mesh);
            CHECK(found.edges == wanted.edges);
            CHECK(found.boundary_edges == wanted.boundary_edges);
            CHECK(found.crowded_edges == wanted.crowded_edges);
            CHECK(found.uncancelled_edges == wanted.uncancelled_edges);
            CHECK(found.disagreeing_edges == wanted.disagreeing_edges);
            CHECK(found.isolated_vertices == wanted.isolated_vertices);
            CHECK(found.non_manifold_vertices == wanted.non_manifold_vertices);
            CHECK(found.duplicate_triangles == wanted.duplicate_triangles);
        }
}

TEST_CASE("two faces back to back, and faces that repeat a vertex, are closed fans", "[geometry]") {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (const std::vector<Index>& corners :
         {std::vector<Index>{0, 1, 2, 0, 2, 1}, {0, 1, 1}, {0, 1, 2, 0, 2, 1, 0, 1, 1}}) {
        mesh.corners = corners;
        const Connectivity found = connectivity_of(mesh), wanted = counted_one_by_one(mesh);
        CHECK(found.edges == wanted.edges);
        CHECK(found.duplicate_triangles == wanted.duplicate_triangles);
        CHECK(found.uncancelled_edges == 0);
        CHECK(found.non_manifold_vertices == wanted.non_manifold_vertices);
    }
}
