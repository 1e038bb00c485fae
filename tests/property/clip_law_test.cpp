// Laws of clip for every plane: the two sides add up, and closed parts stay closed.
#include "geometry/clip/clip.hpp"

#include "base/math/random.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/measure.hpp"

using namespace facetmill;

namespace {

double number(std::uint64_t key, int which) {
    return uniform(hashed(hashed(11, key), static_cast<std::uint64_t>(which)));
}

/// A plane of any direction through some point of the box.
Plane random_plane(std::uint64_t key, const Box& box) {
    Plane plane;
    for (int i = 0; i < 3; ++i) {
        const auto axis = static_cast<std::size_t>(i);
        plane.normal[axis] = number(key, i) - 0.5;
        plane.through[axis] = box.min[axis] + number(key, 3 + i) * box.extent()[axis];
    }
    return plane;
}

/// A plane through three vertices of the mesh.
Plane plane_through_vertices(std::uint64_t key, const Mesh& mesh) {
    const auto pick = [&](int i) {
        return mesh.positions[static_cast<std::size_t>(number(key, 6 + i) *
                                                       static_cast<double>(mesh.vertex_count()))];
    };
    const Vec3 a = pick(0), b = pick(1), c = pick(2);
    return {cross(b - a, c - a), a, 0};
}

Mesh inside_out(Mesh mesh) {
    for (std::size_t c = 0; c < mesh.corners.size(); c += 3) std::swap(mesh.corners[c], mesh.corners[c + 1]);
    return mesh;
}

Mesh moved(Mesh mesh, const Vec3& by, double scale = 1) {
    for (auto& p : mesh.positions) p = p * scale + by;
    return mesh;
}

Mesh both(Mesh a, const Mesh& b) {
    append(a, b);
    return a;
}

std::vector<std::pair<std::string, Mesh>> closed_meshes() {
    using namespace shapes;
    return {{"tetrahedron", tetrahedron()},
            {"cube", cube()},
            {"quad cube", quad_cube()},
            {"cube with seams", uv_cube()},
            {"octahedron", octahedron()},
            {"sphere", icosphere(2)},
            {"torus", torus(14, 9)},
            {"hourglass", hourglass()},
            {"hollow", both(icosphere(2), inside_out(moved(icosphere(1), {0.1, 0.1, 0.1}, 0.5)))},
            {"crossing bodies", both(torus(10, 7), moved(torus(10, 7), {0.5, 0.1, 0.2}))},
            {"crossing cubes with seams", both(uv_cube(), moved(uv_cube(), {0.5, 0.5, 0.25}))},
            {"the same body twice", both(octahedron(), octahedron())},
            {"a body and its inside", both(octahedron(), inside_out(octahedron()))},
            {"touching cubes", both(cube(), moved(cube(), {1, 0, 0}))},
            {"cubes that touch at a stretch", both(cube(), moved(cube(), {1, 0.5, 0.25}))}};
}

ClipSettings both_sides(const Plane& plane) {
    ClipSettings settings;
    settings.planes = {plane};
    settings.keep = Keep::both;
    settings.cap = true;
    settings.cap_primitive = Primitive{0, {}, {}};
    return settings;
}

/// Rounding moves each cut vertex by a few units in the last place of the box. These bodies are within a few
/// units of the origin, so areas and volumes change by no more than this.
constexpr double rounding = 1e-12;

void check_law(const std::string& name, const Mesh& mesh, const Plane& plane) {
    CAPTURE(name, plane.normal.x, plane.normal.y, plane.normal.z, plane.through.x, plane.through.y,
            plane.through.z);
    const ClipResult r = clip(mesh, both_sides(plane));
    CHECK(broken_invariants(r.front).empty());
    CHECK(broken_invariants(r.back).empty());
    CHECK(r.open.empty());
    CHECK(test::closed(r.front));
    CHECK(test::closed(r.back));
    CHECK(std::fabs(test::volume(r.front) + test::volume(r.back) - test::volume(mesh)) < rounding);
    ClipSettings open = both_sides(plane);
    open.cap = false;
    const ClipResult walls = clip(mesh, open);
    CHECK(std::fabs(test::area(walls.front) + test::area(walls.back) - test::area(mesh)) < rounding);
}

} // namespace

TEST_CASE("the sides of random planes add up, and stay closed", "[property]") {
    for (const auto& [name, mesh] : closed_meshes())
        for (std::uint64_t key = 0; key < 12; ++key) check_law(name, mesh, random_plane(key, mesh.bounds()));
}

TEST_CASE("... and of planes through three vertices", "[property]") {
    for (const auto& [name, mesh] : closed_meshes())
        for (std::uint64_t key = 0; key < 12; ++key) {
            const Plane plane = plane_through_vertices(key, mesh);
            if (plane.normal == Vec3{}) continue;
            check_law(name, mesh, plane);
        }
}

TEST_CASE("... and of planes along axes through vertices and along faces", "[property]") {
    for (const auto& [name, mesh] : closed_meshes())
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t v = 0; v < mesh.vertex_count(); v += 1 + mesh.vertex_count() / 4) {
                Plane plane{{}, mesh.positions[v], 0};
                plane.normal[axis] = v % 2 == 0 ? 1 : -1;
                check_law(name, mesh, plane);
            }
}

TEST_CASE("several planes in a row leave closed meshes closed", "[property]") {
    for (const auto& [name, mesh] : closed_meshes())
        for (std::uint64_t key = 100; key < 106; ++key) {
            ClipSettings settings;
            settings.cap = true;
            settings.triangulate = key % 2 == 0;
            settings.keep = key % 3 == 0 ? Keep::back : Keep::front;
            for (std::uint64_t k = 0; k < 5; ++k)
                settings.planes.push_back(random_plane(key * 16 + k % 4, mesh.bounds()));
            CAPTURE(name, key);
            const ClipResult r = clip(mesh, settings);
            for (const Mesh* side : {&r.front, &r.back}) {
                CHECK(broken_invariants(*side).empty());
                CHECK(test::closed(*side));
            }
            CHECK(r.open.empty());
        }
}

TEST_CASE("an edge-manifold mesh stays so when no vertex is on the plane", "[property]") {
    for (const Mesh& mesh : {shapes::icosphere(2), shapes::torus(14, 9), shapes::uv_cube()})
        for (std::uint64_t key = 0; key < 12; ++key) {
            const ClipResult r = clip(mesh, both_sides(random_plane(key, mesh.bounds())));
            REQUIRE(r.on_plane == 0);
            CHECK(test::edge_manifold(r.front));
            CHECK(test::edge_manifold(r.back));
        }
}

TEST_CASE("open meshes add up in area, with whatever can be capped", "[property]") {
    for (const Mesh& mesh :
         {shapes::grid(4, 3), shapes::open_cone(9), shapes::fan3(), shapes::moebius(9), shapes::bowtie()})
        for (std::uint64_t key = 0; key < 12; ++key) {
            const Plane plane = random_plane(key, mesh.bounds());
            ClipSettings settings = both_sides(plane);
            CHECK(broken_invariants(clip(mesh, settings).front).empty());
            settings.cap = false;
            const ClipResult r = clip(mesh, settings);
            CHECK(broken_invariants(r.front).empty());
            CHECK(broken_invariants(r.back).empty());
            // A quad that is not flat has no defined area, and its pieces only approximate it.
            if (mesh.all_triangles())
                CHECK(std::fabs(test::area(r.front) + test::area(r.back) - test::area(mesh)) < rounding);
        }
}
