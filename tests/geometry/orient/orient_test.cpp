#include "support/catch.hpp"
#include "support/clean_laws.hpp"
#include "support/measure.hpp"
#include "support/meshes.hpp"

#include "geometry/inspect/inspect.hpp"
#include "geometry/orient/orient.hpp"
#include "geometry/spatial/rays.hpp"
#include "mesh/invariants.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

Mesh scaled(Mesh mesh, double factor, const Vec3& offset = {}) {
    for (Vec3& p : mesh.positions) p = p * factor + offset;
    return mesh;
}

/// Reverses random faces.
Mesh shaken(Mesh mesh, std::uint64_t seed) {
    std::vector<std::uint8_t> flags(mesh.face_count());
    for (std::size_t f = 0; f < flags.size(); ++f) flags[f] = hashed(seed, f) % 2;
    flip_faces(mesh, flags);
    return mesh;
}

OrientResult oriented(const Mesh& mesh, const OrientSettings& s = {}) {
    OrientResult r = orient(mesh, s);
    CHECK(broken_invariants(r.mesh).empty());
    return r;
}

} // namespace

TEST_CASE("orient makes neighbours agree and the front the outside", "[geometry]") {
    for (const Mesh& mesh : {shapes::icosphere(2), shapes::torus(12, 9), shapes::quad_cube()})
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            const auto r = oriented(shaken(mesh, seed));
            CHECK(inspect(r.mesh).oriented);
            CHECK(test::volume(r.mesh) == Approx(test::volume(mesh)));
            CHECK(oriented(r.mesh).flipped == 0);
        }
}

TEST_CASE("orient: consistent keeps the front that most faces had", "[geometry]") {
    Mesh mesh = shapes::icosphere(1);
    flip_faces(mesh, std::vector<std::uint8_t>(mesh.face_count(), 1));
    std::vector<std::uint8_t> some(mesh.face_count(), 0);
    some[3] = some[40] = 1;
    flip_faces(mesh, some);
    const auto r = oriented(mesh, {OrientMethod::consistent, Nested::cavities});
    CHECK(r.flipped == 2);
    CHECK(test::volume(r.mesh) < 0);
}

TEST_CASE("orient: flip turns every face, twice is as before", "[geometry]") {
    const Mesh mesh = with_uv_seams(shapes::icosphere(1));
    const auto once = oriented(mesh, {OrientMethod::flip, Nested::cavities});
    CHECK(test::volume(once.mesh) == Approx(-test::volume(mesh)));
    const auto twice = oriented(once.mesh, {OrientMethod::flip, Nested::cavities});
    CHECK(test::same_mesh(twice.mesh, mesh));
}

TEST_CASE("orient turns normals that point against their faces, and no others", "[geometry]") {
    Mesh mesh = shapes::uv_cube();
    const Attribute before = *mesh.find("NORMAL", Domain::wedge);
    Mesh turned = mesh; // faces and normals inward: both turn
    flip_faces(turned, std::vector<std::uint8_t>(turned.face_count(), 1));
    CHECK(turned.find("NORMAL", Domain::wedge)->value(0, 0) == -before.value(0, 0));
    CHECK(oriented(turned).mesh.find("NORMAL", Domain::wedge)->data == before.data);
    Mesh wrong = turned; // faces inward, normals right: only the faces turn
    wrong.find("NORMAL", Domain::wedge)->data = before.data;
    CHECK(oriented(wrong).mesh.find("NORMAL", Domain::wedge)->data == before.data);
}

TEST_CASE("orient makes nested components solids and cavities in turn", "[geometry]") {
    Mesh mesh = shapes::icosphere(1);
    append(mesh, scaled(shapes::icosphere(1), 0.5));
    append(mesh, scaled(shapes::cube(), 0.1, {0.05, 0.05, 0.05}));
    append(mesh, scaled(shapes::cube(), 1, {5, 0, 0}));
    const Mesh turned = shaken(mesh, 5);
    const auto r = oriented(turned);
    REQUIRE(r.components.size() == 4);
    const double sphere = test::volume(shapes::icosphere(1));
    CHECK(test::volume(r.mesh) == Approx(sphere - sphere / 8 + 0.001 + 1));
    std::vector<std::size_t> depths;
    for (const auto& p : r.components) depths.push_back(p.depth);
    CHECK(depths == std::vector<std::size_t>{0, 1, 2, 0});
    const auto solids = oriented(turned, {OrientMethod::outward, Nested::solids});
    CHECK(test::volume(solids.mesh) == Approx(sphere + sphere / 8 + 0.001 + 1));
}

TEST_CASE("orient looks past faces with repeated corners", "[geometry]") {
    Mesh mesh = shapes::icosphere(1);
    append(mesh, scaled(shapes::icosphere(1), 0.5));
    const double sphere = test::volume(shapes::icosphere(1));
    const Index far = static_cast<Index>(mesh.vertex_count()) - 1;
    for (const auto& spike : {std::array<Index, 3>{mesh.corners[0], mesh.corners[1], mesh.corners[1]},
                              std::array<Index, 3>{mesh.corners[4], mesh.corners[3], mesh.corners[4]},
                              std::array<Index, 3>{0, 0, 0}, std::array<Index, 3>{0, far, 0}})
        add_face(mesh, spike);
    const auto r = oriented(shaken(mesh, 7));
    CHECK(test::volume(r.mesh) == Approx(sphere - sphere / 8));
    for (const auto& p : r.components) CHECK_FALSE(p.undecided);
    CHECK(r.components.at(1).closed);
    CHECK(r.components.at(1).depth == 1);
}

TEST_CASE("orient takes no component that passes through another for its cavity", "[geometry]") {
    const Mesh ball = shapes::icosphere(2);
    const double volume = test::volume(ball);
    for (const double apart : {0.1, 0.6, 1.2}) {
        Mesh mesh = ball; // most of the second is in the first, its first vertex at least once
        append(mesh, scaled(ball, 1, {-apart, 0.05, -apart}));
        append(mesh, scaled(ball, 0.02)); // a cavity of both
        const auto r = oriented(shaken(mesh, 3));
        REQUIRE(r.components.size() == 3);
        CHECK(r.components[0].depth == 0);
        CHECK(r.components[1].depth == 0);
        const double small = volume * 8e-6;
        const bool in_both = r.components[2].depth == 2;
        CHECK(test::volume(r.mesh) == Approx(2 * volume + (in_both ? small : -small)));
        CHECK(test::same_mesh(oriented(r.mesh).mesh, r.mesh));
    }
}

TEST_CASE("orient lets rays vote on the outside of an open surface", "[geometry]") {
    Mesh bowl = shapes::icosphere(3);
    std::vector<Index> corners;
    for (Index f = 0; f < bowl.face_count(); ++f)
        if (bowl.point(3 * f).z < 0.3)
            corners.insert(corners.end(), &bowl.corners[3 * f], &bowl.corners[3 * f] + 3);
    bowl.corners = corners;
    for (const auto& mesh : {bowl, shaken(bowl, 9)}) {
        const auto r = oriented(mesh);
        CHECK_FALSE(r.components.at(0).undecided);
        CHECK(test::volume(r.mesh) > 0);
    }
    const auto flat = oriented(shapes::grid(4, 4));
    CHECK(flat.components.at(0).undecided);
    CHECK(flat.flipped == 0);
}

TEST_CASE("orient names a Moebius strip and leaves it", "[geometry]") {
    Mesh mesh = shapes::moebius(9);
    append(mesh, shaken(shapes::quad_cube(), 3));
    const auto r = oriented(mesh);
    REQUIRE(r.components.size() == 2);
    CHECK_FALSE(r.components[0].orientable);
    CHECK(r.components[0].flipped == 0);
    CHECK(r.components[1].orientable);
    CHECK(std::equal(r.mesh.corners.begin(), r.mesh.corners.begin() + 36, mesh.corners.begin()));
}

TEST_CASE("rays along axes count a surface right through its edges and vertices", "[geometry]") {
    const Mesh cube = shapes::cube();
    const FaceTree rays(surface_of(cube), FaceTree::Use::rays);
    const auto turns = [&](const Vec3& p, std::size_t axis, bool forward) {
        int sum = 0;
        visit_along_axis(rays, p, axis, forward, [&](Index, int way) { sum += way; });
        return sum;
    };
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const bool forward : {true, false}) {
            CHECK(turns({0.5, 0.5, 0.5}, axis, forward) == 1); // through diagonals
            CHECK(turns({0.25, 0.5, 0.125}, axis, forward) == 1);
            CHECK(turns({2, 2, 2}, axis, forward) == 0);
            CHECK(turns({-1, 0, 0}, axis, forward) == 0); // along edges, through corners
            CHECK(turns({-1, 1, 1}, axis, forward) == 0);
            CHECK(turns({0.5, -1, 0}, axis, forward) == 0);
        }
    const Mesh sphere = shapes::icosphere(2);
    const FaceTree to_sphere(surface_of(sphere), FaceTree::Use::rays);
    for (const Vec3& v : sphere.positions) {
        const Vec3 inside = v * 0.5; // many of these have coordinates of vertices
        int sum = 0;
        visit_along_axis(to_sphere, {inside.x, v.y * 0.5, v.z * 0.5}, 0, true,
                         [&](Index, int way) { sum += way; });
        CHECK(sum == 1);
    }
}
