// Laws of the mesh layer and of its counts, on random meshes.
#include "support/catch.hpp"
#include "support/meshes.hpp"

#include "geometry/inspect/evidence.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "mesh/invariants.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <numeric>

using namespace facetmill;
using namespace facetmill::test;

namespace {

/// All properties that depend neither on numbering nor on rounding.
std::vector<std::int64_t> counts(const Properties& p) {
    return {p.vertices,        p.edges,
            p.faces,           p.components,
            p.euler,           p.boundary_loops,
            p.boundary_edges,  p.degenerate_faces,
            p.duplicate_faces, p.isolated_vertices,
            p.closed,          p.edge_manifold,
            p.vertex_manifold, p.oriented};
}

std::vector<Mesh> noisy_closed_meshes(std::uint64_t seed) {
    return {noisy_icosphere(3, 0.2, seed), noisy_torus(24, 15, 0.02, seed), shapes::quad_cube(),
            with_noise(shapes::uv_cube(), 0.1, seed)};
}

std::vector<Mesh> all_meshes(std::uint64_t seed) {
    auto all = noisy_closed_meshes(seed);
    for (Mesh mesh : {shapes::bowtie(), shapes::fan3(), shapes::hourglass(), shapes::moebius(9),
                      shapes::grid(5, 4), random_triangles(60, 0.3, seed), shapes::open_cone(40)})
        all.push_back(std::move(mesh));
    return all;
}

/// The same surface, faces in another order and vertices with other numbers.
Mesh shuffled(const Mesh& mesh, std::uint64_t seed) {
    const auto order = [&](std::size_t n, std::uint64_t stream) {
        std::vector<Index> o(n);
        std::iota(o.begin(), o.end(), Index{0});
        std::sort(o.begin(), o.end(),
                  [&](Index a, Index b) { return hashed(seed + stream, a) < hashed(seed + stream, b); });
        return o;
    };
    const auto vertices = order(mesh.vertex_count(), 1);
    Mesh result;
    result.positions.resize(mesh.vertex_count());
    for (std::size_t v = 0; v < vertices.size(); ++v) result.positions[vertices[v]] = mesh.positions[v];
    for (const Index f : order(mesh.face_count(), 2)) {
        std::vector<Index> face;
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            face.push_back(vertices[mesh.vertex(c)]);
        std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(hashed(seed, f) % face.size()),
                    face.end());
        add_face(result, face);
    }
    return result;
}

} // namespace

TEST_CASE("law: closed meshes have Euler number 2 (components - genus), and no boundary", "[property]") {
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
        for (const Mesh& mesh : noisy_closed_meshes(seed)) {
            const Properties p = inspect(mesh);
            CHECK((p.closed && p.edge_manifold && p.vertex_manifold && p.oriented));
            CHECK(p.euler == 2 * (p.components - p.genus.value()));
            CHECK(p.boundary_loops == 0);
            CHECK(p.volume.value() > 0);
        }
}

TEST_CASE("law: appending adds all counts, and joins truths", "[property]") {
    const auto meshes = all_meshes(7);
    for (const Mesh& a : meshes)
        for (const Mesh& b : meshes) {
            Mesh both = a;
            append(both, b);
            CHECK(broken_invariants(both).empty());
            const auto x = inspect(a), y = inspect(b), sum = inspect(both);
            auto expected = counts(x);
            const auto other = counts(y);
            for (std::size_t i = 0; i < 10; ++i) expected[i] += other[i];
            for (std::size_t i = 10; i < expected.size(); ++i) expected[i] &= other[i];
            CHECK(counts(sum) == expected);
            CHECK(sum.area == Approx(x.area + y.area).epsilon(1e-12));
        }
}

TEST_CASE("law: a scene counts as its parts appended", "[property]") {
    Scene scene;
    Mesh all;
    for (const Mesh& mesh : noisy_closed_meshes(3)) {
        scene.parts.push_back({.name = "part", .mesh = mesh});
        append(all, mesh);
    }
    const Properties of_scene = inspect(scene), of_mesh = inspect(all);
    CHECK(counts(of_scene) == counts(of_mesh));
    CHECK(of_scene.genus == of_mesh.genus);
    CHECK(of_scene.volume.value() == Approx(of_mesh.volume.value()).epsilon(1e-12));
}

TEST_CASE("law: numbering does not matter", "[property]") {
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
        for (const Mesh& mesh : all_meshes(seed)) {
            const Mesh other = shuffled(mesh, seed);
            CHECK(counts(inspect(other)) == counts(inspect(mesh)));
            CHECK(find_self_intersections(other).count == find_self_intersections(mesh).count);
        }
}

TEST_CASE("law: welding a torn mesh brings it back", "[property]") {
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
        for (const Mesh& mesh : noisy_closed_meshes(seed)) {
            const Mesh whole = triangulated(mesh);
            Mesh soup = torn_apart(whole);
            CHECK_FALSE(inspect(soup).closed);
            weld_exact(soup);
            CHECK(counts(inspect(soup)) == counts(inspect(whole)));
        }
}

TEST_CASE("law: wedges do not bear on topology", "[property]") {
    for (const Mesh& mesh : all_meshes(5)) {
        const Mesh seamed = with_uv_seams(mesh);
        CHECK(broken_invariants(seamed).empty());
        CHECK(counts(inspect(seamed)) == counts(inspect(mesh)));
        CHECK(find_self_intersections(seamed).pairs == find_self_intersections(mesh).pairs);
    }
}

TEST_CASE("law: triangulating keeps vertices, area, volume and closedness", "[property]") {
    const Mesh mesh = shapes::quad_cube(), cut = triangulated(mesh);
    const Properties before = inspect(mesh), after = inspect(cut);
    CHECK(after.euler == before.euler);
    CHECK(after.closed);
    CHECK(after.area == before.area);
    CHECK(after.volume == before.volume);
}

TEST_CASE("law: a mirrored, turned or moved mesh keeps its counts; its volume scales", "[property]") {
    Transform t;
    t.m[0][0] = -2;
    t.m[1][1] = 0;
    t.m[1][2] = 0.5;
    t.m[2][1] = 0.5;
    t.m[2][2] = 0;
    t.m[0][3] = 8;
    for (const Mesh& mesh : noisy_closed_meshes(2)) {
        Mesh moved = mesh;
        apply(moved, t);
        CHECK(counts(inspect(moved)) == counts(inspect(mesh)));
        CHECK(inspect(moved).volume.value() ==
              Approx(inspect(mesh).volume.value() * std::abs(t.determinant())).epsilon(1e-12));
        const Properties in_world = inspect(Part{.name = "p", .mesh = mesh, .transform = t});
        CHECK(in_world.volume.value() == Approx(inspect(moved).volume.value()).epsilon(1e-12));
    }
}

TEST_CASE("law: evidence is there exactly when a truth does not hold", "[property]") {
    for (const Mesh& mesh : all_meshes(4)) {
        const Properties p = inspect(mesh, {.self_intersections = true});
        CHECK(locations_against(mesh, *property_named("closed")).empty() == p.closed);
        CHECK(locations_against(mesh, *property_named("edge_manifold")).empty() == p.edge_manifold);
        CHECK(locations_against(mesh, *property_named("vertex_manifold")).empty() == p.vertex_manifold);
        CHECK(locations_against(mesh, *property_named("oriented")).empty() == p.oriented);
        for (const auto& [name, count] : {std::pair{"degenerate_faces", p.degenerate_faces},
                                          {"duplicate_faces", p.duplicate_faces},
                                          {"isolated_vertices", p.isolated_vertices},
                                          {"self_intersections", p.self_intersections.value()}})
            CHECK(locations_against(mesh, *property_named(name)).size() ==
                  static_cast<std::size_t>(std::min<std::int64_t>(10, count)));
    }
}

TEST_CASE("law: one thread or many, the same to the last bit", "[property]") {
    const Mesh mesh = noisy_torus(200, 150, 0.01, 9);
    const auto look = [&] {
        const auto p = inspect(mesh);
        const auto edges = build_edges(mesh);
        return std::tuple(counts(p), p.area, p.volume, edges.edge_corners, edges.corner_edge,
                          find_self_intersections(mesh, {.limit = SIZE_MAX}).pairs);
    };
    const int before = threads();
    set_threads(1);
    const auto alone = look();
    for (const int n : {2, 3}) {
        set_threads(n);
        CHECK(look() == alone);
    }
    set_threads(before);
}
