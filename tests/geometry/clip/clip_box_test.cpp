#include "geometry/clip/clip.hpp"
#include "geometry/cut/score.hpp"
#include "geometry/inspect/inspect.hpp"

#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "stage/options/box.hpp"
#include "support/catch.hpp"
#include "support/measure.hpp"
#include "support/meshes.hpp"

using namespace facetmill;

namespace {

ClipSettings at_box(const BoxOption& box, Keep keep = Keep::both) {
    ClipSettings settings;
    settings.planes = planes_of(box);
    settings.convex = true;
    settings.keep = keep;
    settings.cap = true;
    settings.cap_numbers = true;
    return settings;
}

BoxOption corners(const Vec3& min, const Vec3& max) {
    BoxOption box;
    box.min = min;
    box.max = max;
    return box;
}

BoxOption turned() {
    BoxOption box;
    box.centre = {0.2, 0.1, 0};
    box.size = {0.9, 1.1, 0.7};
    box.axis = {1, 2, 3};

    box.angle = Angle::degrees(33);
    return box;
}

Mesh both(Mesh a, const Mesh& b) {
    append(a, b);
    return a;
}

} // namespace

TEST_CASE("a box keeps what is in it, and the rest is the rest", "[geometry]") {
    const ClipResult r = clip(shapes::cube(), at_box(corners({0.25, 0.25, 0.25}, {2, 0.75, 0.75})));
    CHECK(test::volume(r.front) == Approx(0.75 * 0.25));
    CHECK(test::volume(r.back) == Approx(1 - 0.75 * 0.25));
    CHECK(test::area(r.front) == Approx(2 * 0.25 + 4 * 0.375));
    for (const Mesh* m : {&r.front, &r.back}) {
        CHECK(broken_invariants(*m).empty());
        CHECK(test::closed(*m));
        CHECK(test::edge_manifold(*m));
        CHECK_FALSE(m->find("#trace", Domain::vertex));
        CHECK_FALSE(m->find("#trace", Domain::face));
    }
}

TEST_CASE("a box around everything, and one beside it", "[geometry]") {
    const ClipResult around = clip(shapes::uv_cube(), at_box(corners({-1, -1, -1}, {2, 2, 2})));
    CHECK(around.front.corners == shapes::uv_cube().corners);
    CHECK(around.back.face_count() == 0);
    const ClipResult beside = clip(shapes::uv_cube(), at_box(corners({3, 3, 3}, {4, 4, 4})));
    CHECK(beside.front.face_count() == 0);
    CHECK(beside.back.face_count() == 12);
    CHECK(test::volume(beside.back) == Approx(1));
}

TEST_CASE("a turned box leaves closed meshes closed on both sides", "[geometry]") {
    const auto inside_out = [](Mesh m) {
        for (std::size_t c = 0; c < m.corners.size(); c += 3) std::swap(m.corners[c], m.corners[c + 1]);
        return m;
    };
    const Mesh sphere = shapes::icosphere(3);
    Mesh core = shapes::icosphere(2);
    for (auto& p : core.positions) p = p * 0.5;
    const std::vector<std::pair<std::string, Mesh>> meshes{
        {"sphere", sphere},
        {"torus", shapes::torus(30, 20)},
        {"seams", test::moved(shapes::uv_cube(), {-0.4, -0.5, -0.6})},
        {"hollow", both(sphere, inside_out(core))},
        {"crossing", both(shapes::torus(10, 7), test::moved(shapes::torus(10, 7), {0.5, 0.1, 0.2}))},
        {"crossing seams", both(shapes::uv_cube(), test::moved(shapes::uv_cube(), {0.25, 0.25, 0.125}))}};
    for (const auto& [name, mesh] : meshes) {
        CAPTURE(name);
        const ClipResult r = clip(mesh, at_box(turned()));
        CHECK(r.front.face_count() > 0);
        CHECK(r.back.face_count() > 0);
        for (const Mesh* m : {&r.front, &r.back}) {
            CHECK(broken_invariants(*m).empty());
            CHECK(test::closed(*m));
        }
        CHECK(std::fabs(test::volume(r.front) + test::volume(r.back) - test::volume(mesh)) < 1e-12);
    }
}

TEST_CASE("a box whose planes touch vertices and edges leaves manifold solids on both sides", "[geometry]") {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        CAPTURE(seed);
        Mesh terrain = shapes::grid(8, 8);
        for (std::size_t v = 0; v < terrain.positions.size(); ++v)
            terrain.positions[v].z = std::floor(test::between(1, 6, seed, v));
        const Mesh solid = test::solid_below(terrain);
        const ClipResult r = clip(solid, at_box(corners({1, -1, -1}, {5, 6, 3})));
        for (const Mesh* m : {&r.front, &r.back}) {
            CHECK(broken_invariants(*m).empty());
            CHECK(test::closed(*m));
            CHECK(test::edge_manifold(*m));
            CHECK(inspect(*m).vertex_manifold);
        }
        CHECK(test::volume(r.front) + test::volume(r.back) == Approx(test::volume(solid)));
    }
}

TEST_CASE("caps around a box look into it, with numbers and normals of their own", "[geometry]") {
    const Mesh body = test::moved(shapes::uv_cube(), {-0.4, -0.5, -0.6});
    const ClipResult r = clip(body, at_box(corners({-0.2, -0.2, -0.2}, {0.2, 0.2, 5})));
    const Attribute *normals = r.back.find("NORMAL", Domain::wedge),
                    *cut = r.back.find("cut_id", Domain::face);
    REQUIRE(normals);
    REQUIRE(cut);
    std::size_t caps = 0;
    for (Index f = 0; f < r.back.face_count(); ++f) {
        caps += cut->value(f, 0) > 0;
        std::vector<Vec3> p;
        for (const Index w : r.back.face_wedges(f)) p.push_back(r.back.positions[r.back.vertex_of_wedge(w)]);
        Vec3 n;
        for (std::size_t i = 1; i + 1 < p.size(); ++i) n += cross(p[i] - p[0], p[i + 1] - p[0]);
        n = normalised(n);
        for (const Index w : r.back.face_wedges(f))
            for (int i = 0; i < 3; ++i)
                CHECK(normals->value(w, i) == Approx(n[static_cast<std::size_t>(i)]).margin(1e-6));
    }
    const Attribute* front_cut = r.front.find("cut_id", Domain::face);
    for (Index f = 0; f < r.front.face_count(); ++f) caps -= front_cut->value(f, 0) > 0;
    CHECK(caps == 0); // as many as in front
    CHECK(test::volume(r.back) == Approx(1 - 0.4 * 0.4 * 0.6));
}

TEST_CASE("an open surface falls into the parts in a box and around it", "[geometry]") {
    ClipSettings settings = at_box(corners({0.5, 0.5, -1}, {2.25, 1.5, 1}));
    settings.cap = false;
    const ClipResult r = clip(shapes::grid(4, 3), settings);
    CHECK(test::area(r.front) == Approx(1.75));
    CHECK(test::area(r.back) == Approx(12 - 1.75));
}

TEST_CASE("scoring takes nothing away and opens no crack", "[geometry]") {
    const Mesh sphere = shapes::icosphere(3);
    const Plane plane{{1, 0.7, 0.3}, {0.1, 0.2, 0.05}, 0};
    CutMemory memory;
    const ScoreResult all = score(sphere, {plane, {}, FlatSide::by_normal, {}}, memory);
    CHECK(broken_invariants(all.mesh).empty());
    CHECK(test::closed(all.mesh));
    CHECK(test::edge_manifold(all.mesh));
    CHECK(test::euler(all.mesh) == 2);
    CHECK(test::volume(all.mesh) == Approx(test::volume(sphere)));
    for (const auto side : all.sides) CHECK(side != 0);

    std::vector<std::uint8_t> some(sphere.face_count());
    for (std::size_t f = 0; f < some.size(); ++f) some[f] = sphere.point(3 * static_cast<Index>(f)).z > 0;
    CutMemory other;
    const ScoreResult part = score(sphere, {plane, some, FlatSide::by_normal, {}}, other);
    CHECK(part.cut_faces > 0);
    CHECK(part.cut_faces < all.cut_faces);
    CHECK(broken_invariants(part.mesh).empty());
    CHECK(test::closed(part.mesh));
    CHECK(test::euler(part.mesh) == 2);
}
