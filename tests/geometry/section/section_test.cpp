#include "support/catch.hpp"

#include "geometry/clip/clip.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/section/section.hpp"
#include "mesh/shapes.hpp"

using namespace facetmill;

namespace {

Plane across_z(double z) { return {{0, 0, 1}, {0, 0, z}, 0}; }

Section cut(const Mesh& mesh, const Plane& plane) { return section(mesh, {plane, {0}, {}}).at(0); }

/// The cube of side 1 from the origin, minus the cube of side 1/2 at its centre.
Mesh hollow_cube() {
    Mesh outer = shapes::cube(), inner = shapes::cube();
    for (auto& p : inner.positions) p = p * 0.5 + Vec3{0.25, 0.25, 0.25};
    for (std::size_t c = 0; c < inner.corners.size(); c += 3)
        std::swap(inner.corners[c + 1], inner.corners[c + 2]);
    append(outer, inner);
    return outer;
}

} // namespace

TEST_CASE("a cube's section is a square, anticlockwise, in world coordinates", "[geometry]") {
    const Section s = cut(shapes::cube(), across_z(0.25));
    REQUIRE(s.contours.size() == 1);
    const Contour& c = s.contours[0];
    CHECK(c.kind == polygon::Kind::quad);
    CHECK(c.orientation == 1);
    CHECK(c.role == ContourRole::outline);
    CHECK(c.area == 1);
    CHECK(c.length == 4);
    REQUIRE(c.moments);
    CHECK(c.moments->centroid == Vec2{0.5, 0.5});
    CHECK(s.frame.point(c.moments->centroid) == Vec3{0.5, 0.5, 0.25});
}

TEST_CASE("quads and triangles give the same section", "[geometry]") {
    const Plane oblique{{1, 2, 3}, {0.4, 0.5, 0.6}, 0};
    const Section a = cut(shapes::cube(), oblique), b = cut(shapes::quad_cube(), oblique);
    CHECK(a.points.size() == b.points.size());
    CHECK(a.area == Approx(b.area).epsilon(1e-14));
    CHECK(a.contours.at(0).kind == b.contours.at(0).kind);
}

TEST_CASE("a face in the plane counts when it is a top", "[geometry]") {
    CHECK(cut(shapes::cube(), across_z(1)).area == 1);
    const Section floor = cut(shapes::cube(), across_z(0));
    CHECK(floor.contours.empty());
    CHECK(floor.collapsed == 0);
    // From below, the floor is the top.
    CHECK(cut(shapes::cube(), {{0, 0, -1}, {0, 0, 0}, 0}).area == 1);
}

TEST_CASE("a plane that only touches a tip gives nothing, and says so", "[geometry]") {
    const Section tip = cut(shapes::octahedron(), across_z(1));
    CHECK(tip.contours.empty());
    CHECK(tip.collapsed == 1);
}

TEST_CASE("a plane through vertices and edges", "[geometry]") {
    const Section s = cut(shapes::octahedron(), across_z(0)); // through four vertices
    REQUIRE(s.contours.size() == 1);
    CHECK(s.contours[0].kind == polygon::Kind::quad);
    CHECK(s.area == 2);
    const Section diagonal = cut(shapes::cube(), {{1, -1, 0}, {}, 0}); // along two edges
    REQUIRE(diagonal.contours.size() == 1);
    CHECK(diagonal.contours[0].kind == polygon::Kind::quad);
    CHECK(diagonal.area == Approx(std::sqrt(2.0)));
}

TEST_CASE("a plane that misses gives an empty section", "[geometry]") {
    const Section s = cut(shapes::cube(), across_z(7));
    CHECK(s.contours.empty());
    CHECK(s.area == 0);
}

TEST_CASE("holes run clockwise and know their outline", "[geometry]") {
    const Section s = cut(hollow_cube(), across_z(0.5));
    REQUIRE(s.contours.size() == 2);
    const std::size_t hole = s.contours[0].role == ContourRole::hole ? 0 : 1;
    CHECK(s.contours[hole].role == ContourRole::hole);
    CHECK(s.contours[hole].orientation == -1);
    CHECK(s.contours[hole].parent == 1 - hole);
    CHECK(s.contours[1 - hole].parent == none);
    CHECK(s.area == 0.75);
    CHECK(polygon::classify(s.filled()) == polygon::Kind::complex);
}

TEST_CASE("a torus is cut into two rings, or a ring with a hole", "[geometry]") {
    const Mesh torus = shapes::torus(64, 32);
    CHECK(cut(torus, {{1, 0, 0}, {0.01, 0, 0}, 0}).contours.size() == 2);
    const Section flat = cut(torus, across_z(0.01));
    REQUIRE(flat.contours.size() == 2);
    CHECK(flat.contours[0].role != flat.contours[1].role);
}

TEST_CASE("bodies inside bodies are inner contours, and count twice", "[geometry]") {
    Mesh two = shapes::cube();
    Mesh small = shapes::cube();
    for (auto& p : small.positions) p = p * 0.5 + Vec3{0.25, 0.25, 0.25};
    append(two, small);
    const Section s = cut(two, across_z(0.5));
    CHECK(s.contours.at(1).role == ContourRole::inner);
    CHECK(s.area == 1.25);
    CHECK(s.filled().size() == 1);
}

TEST_CASE("an open mesh gives open contours", "[geometry]") {
    const Section s = cut(shapes::grid(3, 3), {{1, 0, 0}, {1.5, 0, 0}, 0});
    REQUIRE(s.contours.size() == 1);
    CHECK(s.contours[0].role == ContourRole::open);
    CHECK(s.contours[0].length == 3);
    CHECK(s.ring(s.contours[0]).size() == 2);
    CHECK_FALSE(s.contours[0].moments);
}

TEST_CASE("where faces disagree, contours are turned by nesting", "[geometry]") {
    Mesh mesh = hollow_cube();
    for (std::size_t c = 0; c < mesh.corners.size(); c += 9)
        std::swap(mesh.corners[c + 1], mesh.corners[c + 2]);
    const Section s = cut(mesh, across_z(0.4));
    CHECK_FALSE(s.oriented);
    CHECK(s.contours.size() == 2);
    CHECK(s.area == Approx(0.75));
}

TEST_CASE("a stack adds up to the volume", "[geometry]") {
    const Mesh ball = shapes::icosphere(4);
    SectionSettings settings{{{1, 1, 1}, {0, 0, 0}, 0}, {}, {}};
    const int n = 200;
    for (int i = 0; i < n; ++i) settings.heights.push_back(-1 + (i + 0.5) * 2 / n);
    double sum = 0;
    for (const Section& s : section(ball, settings)) sum += s.area * 2 / n;
    CHECK(sum == Approx(*inspect(ball).volume).epsilon(1e-4));
}

TEST_CASE("each section of a stack is the section at its height", "[geometry]") {
    const Mesh torus = shapes::torus(31, 17);
    SectionSettings settings{{{0.3, -0.2, 0.9}, {0, 0, 0}, 0}, {-0.5, -0.1, 0, 0.2, 9}, {}};
    const auto stack = section(torus, settings);
    REQUIRE(stack.size() == 5);
    for (std::size_t k = 0; k < stack.size(); ++k) {
        SectionSettings one = settings;
        one.heights = {settings.heights[k]};
        const Section alone = section(torus, one).at(0);
        CHECK(stack[k].points == alone.points);
        CHECK(stack[k].area == alone.area);
    }
    CHECK(stack[4].contours.empty());
}

TEST_CASE("parts are cut where they stand, mirrored ones too", "[geometry]") {
    Transform to_world;
    to_world.m[0][0] = -2;
    to_world.m[1][1] = 3;
    to_world.m[2][2] = 0.5;
    to_world.m[2][3] = 10;
    const auto s = section(shapes::cube(), {across_z(10.25), {0}, to_world}).at(0);
    CHECK(s.area == 6);
    REQUIRE(s.contours.size() == 1);
    CHECK(s.contours[0].moments->centroid == Vec2{-1, 1.5});
}

TEST_CASE("concave faces are cut several times", "[geometry]") {
    // A prism over a U, its two ends single faces of eight corners.
    const std::vector<Vec2> u{{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
    Mesh prism;
    for (const double z : {0.0, 1.0})
        for (const Vec2& p : u) prism.positions.push_back({p.x, p.y, z});
    const auto n = static_cast<Index>(u.size());
    std::vector<Index> bottom, top;
    for (Index i = 0; i < n; ++i) {
        bottom.push_back(n - 1 - i);
        top.push_back(n + i);
    }
    add_face(prism, bottom);
    add_face(prism, top);
    for (Index i = 0; i < n; ++i) add_face(prism, std::vector<Index>{i, (i + 1) % n, n + (i + 1) % n, n + i});
    const Section s = cut(prism, {{0, 1, 0}, {0, 2, 0}, 0});
    CHECK(s.contours.size() == 2);
    CHECK(s.area == 2);
    for (const Contour& c : s.contours) CHECK(c.kind == polygon::Kind::quad);
    CHECK(cut(prism, across_z(0.5)).contours.at(0).kind == polygon::Kind::concave);
}

TEST_CASE("frames are right-handed and keep world coordinates along the axes", "[geometry]") {
    for (const Vec3 n : {Vec3{0, 0, 1}, Vec3{0, 0, -2}, Vec3{5, 0, 0}, Vec3{0, -1, 0}, Vec3{1, 2, 3}}) {
        const SectionFrame f = frame_of({n, {1, 2, 3}, 0});
        CHECK(length(cross(f.u, f.v) - f.normal) < 1e-15);
        CHECK(std::abs(dot(f.origin - Vec3{1, 2, 3}, n)) < 1e-14);
        CHECK(length(f.point({3, 4}) - (f.origin + f.u * 3 + f.v * 4)) == 0);
    }
    CHECK(frame_of(across_z(0.2)).flat({3, 4, 0.2}) == Vec2{3, 4});
    CHECK(frame_of({{2, 0, 0}, {}, -4}).origin == Vec3{2, 0, 0});
}

TEST_CASE("a section where a clip was sees the cap as one face in the plane", "[geometry]") {
    const Plane plane{{0.3, -0.7, 0.61}, {0.11, 0.07, 0.05}, 0};
    ClipSettings settings;
    settings.planes = {plane};
    settings.keep = facetmill::Keep::both;
    settings.cap = true;
    const Mesh sphere = shapes::icosphere(3);
    const ClipResult sides = clip(sphere, settings);
    REQUIRE_FALSE(sides.memory.entries.at(0).points.empty()); // slightly off the plane because of rounding
    Plane longer = plane;
    longer.normal *= -2;
    const Section bottom = section(sides.front, {plane, {0}, {}, &sides.memory}).at(0);
    CHECK(bottom.contours.empty());
    CHECK(bottom.collapsed == 0);
    const Section top = section(sides.back, {plane, {0}, {}, &sides.memory}).at(0),
                  below = section(sides.front, {longer, {0}, {}, &sides.memory}).at(0);
    REQUIRE(top.contours.size() == 1);
    CHECK(top.area == Approx(cut(sphere, plane).area).epsilon(1e-13));
    CHECK(below.area == Approx(top.area).epsilon(1e-13));
    // Forgotten, some of the points are above and some below.
    CHECK(section(sides.front, {plane, {0}, {}}).at(0).contours.size() +
              section(sides.front, {plane, {0}, {}}).at(0).collapsed >
          0);
}

namespace {

/// Walls over a ring, from z = 0 to 1.
Mesh walls_over(const std::vector<Vec2>& ring) {
    Mesh mesh;
    const auto n = static_cast<Index>(ring.size());
    for (const double z : {0.0, 1.0})
        for (const Vec2& p : ring) mesh.positions.push_back({p.x, p.y, z});
    for (Index i = 0; i < n; ++i) add_face(mesh, std::vector<Index>{i, (i + 1) % n, n + (i + 1) % n, n + i});
    return mesh;
}

} // namespace

TEST_CASE("a contour that crosses itself is there, and all that it winds around is inside", "[geometry]") {
    struct Case {
        std::vector<Vec2> ring;
        double area;
        Vec2 centroid;
    };
    const double fifth = 2 * M_PI / 5, inner = (3 - std::sqrt(5.0)) / 2;
    std::vector<Vec2> star;
    for (const int k : {0, 2, 4, 1, 3}) star.push_back({std::cos(k * fifth), std::sin(k * fifth)});
    const Case cases[] = {
        {{{0, 0}, {1, 0}, {0, 1}, {1, 1}}, 0.5, {0.5, 0.5}},                    // as much either way
        {{{0, 0}, {6, 0}, {2, 4}, {4, 4}}, 10, {3, (9.0 + 1 * 11.0 / 3) / 10}}, // heights: 1 and 3 2/3
        {star, 5 * inner * std::sin(M_PI / 5), {0, 0}},
    };
    for (const Case& c : cases) {
        const Section s = cut(walls_over(c.ring), across_z(0.5));
        REQUIRE(s.contours.size() == 1);
        const Contour& contour = s.contours[0];
        CHECK(s.collapsed == 0);
        CHECK(contour.kind == polygon::Kind::self_intersecting);
        CHECK(contour.role == ContourRole::outline);
        CHECK(contour.area == Approx(c.area));
        CHECK(s.area == contour.area);
        REQUIRE(contour.moments);
        CHECK(contour.moments->centroid.x == Approx(c.centroid.x).margin(1e-12));
        CHECK(contour.moments->centroid.y == Approx(c.centroid.y).margin(1e-12));
        double hatched = 0;
        for (const auto& line : polygon::hatch(s.filled(), {.spacing = 0.001, .direction = {0.6, 0.8}}))
            hatched += length(line.b - line.a) * 0.001;
        CHECK(hatched == Approx(c.area).epsilon(0.01));
    }
}

TEST_CASE("the section of a mesh that is inside out is told", "[geometry]") {
    Mesh cube = shapes::cube();
    for (std::size_t c = 0; c < cube.corners.size(); c += 3) std::swap(cube.corners[c], cube.corners[c + 1]);
    const Section s = cut(cube, across_z(0.5));
    CHECK(s.area == -1);
    CHECK(s.inside_out() == 1);
    CHECK(cut(shapes::cube(), across_z(0.5)).inside_out() == 0);
    CHECK(cut(hollow_cube(), across_z(0.5)).inside_out() == 0);
}
