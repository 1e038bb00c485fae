#include "support/catch.hpp"
#include "support/measure.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/measure/measure.hpp"
#include "geometry/thicken/thicken.hpp"
#include "mesh/shapes.hpp"
#include "parallel/allocation_cap.hpp"
#include "parallel/parallel.hpp"
#include "support/meshes.hpp"
#include "support/polygons.hpp"

#include <limits>

using namespace facetmill;

namespace {

Mesh placed(Mesh mesh, const Vec3& scale, const Vec3& shift) {
    for (auto& p : mesh.positions) p = Vec3{p.x * scale.x, p.y * scale.y, p.z * scale.z} + shift;
    return mesh;
}

/// An L of three unit cubes along x and y, its top and bottom one concave polygon each.
Mesh l_prism() {
    Mesh m;
    const double xy[][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    for (const double z : {0.0, 1.0})
        for (const auto& p : xy) m.positions.push_back({p[0], p[1], z});
    const auto face = [&](std::vector<Index> corners) { add_face(m, corners); };
    face({5, 4, 3, 2, 1, 0});
    face({6, 7, 8, 9, 10, 11});
    for (Index i = 0; i < 6; ++i) face({i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6});
    return m;
}

void check_close(const Vec3& a, const Vec3& b, double margin = 1e-14) { CHECK(length(a - b) <= margin); }

} // namespace

TEST_CASE("a box has the mass of the textbook, wherever it stands", "[geometry]") {
    for (const Mesh& cube : {shapes::cube(), shapes::quad_cube()}) {
        const auto r = measure_mass(placed(cube, {2, 3, 4}, {1000, -2000, 3000}));
        CHECK(r.shell.area == Approx(52).epsilon(1e-14));
        check_close(r.shell.centroid, {1001, -1998.5, 3002}, 1e-11);
        CHECK(r.solid->volume == Approx(24).epsilon(1e-14));
        check_close(r.solid->centroid, {1001, -1998.5, 3002}, 1e-11);
        const auto i = inertia_of(r.solid->spread); // V/12 (b^2 + c^2)
        CHECK(i.xx == Approx(50).epsilon(1e-13));
        CHECK(i.yy == Approx(40).epsilon(1e-13));
        CHECK(i.zz == Approx(26).epsilon(1e-13));
        CHECK(std::abs(i.xy) + std::abs(i.xz) + std::abs(i.yz) < 1e-11);
    }
}

TEST_CASE("a corner of a cube has the mass of the textbook", "[geometry]") {
    Mesh m;
    m.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    m.corners = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    const auto r = measure_mass(m);
    CHECK(r.shell.area == Approx(1.5 + std::sqrt(3.0) / 2).epsilon(1e-14));
    CHECK(r.solid->volume == Approx(1.0 / 6).epsilon(1e-14));
    check_close(r.solid->centroid, {0.25, 0.25, 0.25});
    // About the origin xx is 1/60 and xy 1/120. Steiner's theorem subtracts V/16 from both.
    CHECK(r.solid->spread.xx == Approx(1.0 / 60 - 1.0 / 96).epsilon(1e-13));
    CHECK(r.solid->spread.xy == Approx(1.0 / 120 - 1.0 / 96).epsilon(1e-13));
}

TEST_CASE("concave polygons count their inside only", "[geometry]") {
    const auto r = measure_mass(l_prism());
    CHECK(r.shell.area == Approx(14).epsilon(1e-14));
    CHECK(r.solid->volume == Approx(3).epsilon(1e-14));
    check_close(r.solid->centroid, {5.0 / 6, 5.0 / 6, 0.5});
    const SolidMass cube = *measure_mass(shapes::cube()).solid;
    SolidMass right = cube, up = cube;
    right.centroid.x += 1;
    up.centroid.y += 1;
    const SolidMass sum = joined(joined(cube, right), up);
    CHECK(sum.volume == Approx(3).epsilon(1e-14));
    check_close(sum.centroid, r.solid->centroid);
    CHECK(sum.spread.xx == Approx(r.solid->spread.xx).epsilon(1e-13));
    CHECK(sum.spread.xy == Approx(r.solid->spread.xy).epsilon(1e-13));
    CHECK(sum.spread.zz == Approx(r.solid->spread.zz).epsilon(1e-13));
}

TEST_CASE("an open surface has a shell and no solid; one inside out has a negative solid", "[geometry]") {
    const auto sheet = measure_mass(shapes::grid(4, 2));
    CHECK(sheet.shell.area == 8);
    check_close(sheet.shell.centroid, {2, 1, 0});
    CHECK_FALSE(sheet.solid.has_value());
    Mesh turned = shapes::cube();
    for (std::size_t c = 0; c < turned.corners.size(); c += 3)
        std::swap(turned.corners[c], turned.corners[c + 1]);
    CHECK(measure_mass(turned).solid->volume == Approx(-1));
    check_close(measure_mass(turned).solid->centroid, {0.5, 0.5, 0.5});
    CHECK(measure_mass(Mesh{}).shell.area == 0);
}

TEST_CASE("a surface doubled on itself has no volume, whatever the rounding", "[geometry]") {
    Mesh ball = shapes::icosphere(3);
    for (Vec3& p : ball.positions) p = p * 0.1 + Vec3{1.3, 2.7, 0.9};
    const auto mass = measure_mass(two_sided(ball).mesh);
    REQUIRE(mass.solid);
    CHECK(mass.solid->volume == 0);
    CHECK(mass.shell.area == Approx(2 * test::area(ball)));
    Mesh plate = shapes::cube(); // thin, but a solid
    for (Vec3& p : plate.positions) p.z *= 1e-9;
    CHECK(measure_mass(plate).solid->volume == Approx(1e-9));
}

TEST_CASE("the volume is that of the inspection", "[geometry]") {
    const Mesh mesh = test::noisy_torus(40, 20, 0.02, 3);
    CHECK(measure_mass(mesh).solid->volume == Approx(*inspect(mesh).volume).epsilon(1e-13));
    CHECK(measure_mass(mesh).shell.area == Approx(inspect(mesh).area).epsilon(1e-13));
}

TEST_CASE("eigenvectors are a right-handed frame that turns the matrix diagonal", "[geometry]") {
    const Symmetric m{4, 1, -2, 3, 0.5, 7};
    const Eigen3 e = eigen(m);
    CHECK((e.values[0] <= e.values[1] && e.values[1] <= e.values[2]));
    CHECK(e.values[0] + e.values[1] + e.values[2] == Approx(14).epsilon(1e-14));
    for (std::size_t i = 0; i < 3; ++i) check_close(m * e.vectors[i], e.vectors[i] * e.values[i], 1e-14 * 7);
    CHECK(dot(cross(e.vectors[0], e.vectors[1]), e.vectors[2]) == Approx(1).epsilon(1e-14));
    CHECK(eigen(Symmetric{2, 0, 0, 2, 0, 2}).vectors[0] == Vec3{1, 0, 0});
}

TEST_CASE("edges turn by a right angle around a cube, and not at all within its sides", "[geometry]") {
    const EdgeResult r = measure_edges(shapes::cube());
    CHECK(r.length.count == 18);
    CHECK(r.length.minimum == 1);
    CHECK(r.length.maximum == Approx(std::sqrt(2.0)));
    CHECK((r.convex == 12 && r.flat == 6 && r.concave == 0 && r.feature == 12));
    CHECK(r.turn.maximum == Approx(pi / 2).epsilon(1e-15));
    const EdgeResult l = measure_edges(l_prism());
    CHECK((l.convex == 17 && l.concave == 1));
    CHECK(l.turn.minimum == Approx(-pi / 2).epsilon(1e-15));
    CHECK(measure_edges(shapes::grid(2, 2)).boundary == 8);
    CHECK(measure_edges(shapes::fan3()).non_manifold == 1);
}

TEST_CASE("angles at corners, reflex ones too, and the shape of triangles", "[geometry]") {
    const FaceResult r = measure_faces(l_prism());
    CHECK(r.area.count == 8);
    CHECK(r.area.maximum == Approx(3));
    CHECK(r.angle.maximum == Approx(1.5 * pi).epsilon(1e-15));
    CHECK(r.angle.minimum == Approx(0.5 * pi).epsilon(1e-15));
    CHECK(r.kinds.count(polygon::Kind::concave) == 2);
    CHECK(r.kinds.count(polygon::Kind::quad) == 6);
    const FaceResult t = measure_faces(shapes::octahedron());
    CHECK(t.angle.minimum == Approx(pi / 3).epsilon(1e-15));
    CHECK(t.aspect_ratio.maximum == Approx(1).epsilon(1e-14));
}

TEST_CASE("curvature of a sphere is one, and the missing angles sum to Euler's number", "[geometry]") {
    const CurvatureResult r = measure_curvature(shapes::icosphere(5));
    CHECK(r.of_gaussian.mean == Approx(1).epsilon(0.01));
    CHECK(r.of_mean.mean == Approx(1).epsilon(0.01));
    CHECK(r.total == Approx(4 * pi).epsilon(1e-12));
    CHECK(measure_curvature(shapes::torus(30, 12)).total == Approx(0).margin(1e-11));
    CHECK(measure_curvature(shapes::grid(3, 3)).total == Approx(2 * pi).epsilon(1e-13));
    CHECK(measure_curvature(shapes::grid(3, 3)).of_gaussian.count == 4); // the inner vertices
    CHECK(measure_curvature(shapes::quad_cube()).total == Approx(4 * pi).epsilon(1e-13));
}

TEST_CASE("edges and curvature together are as apart, and look at the edges once", "[geometry]") {
    const auto same = [](const Statistics& a, const Statistics& b) {
        return a.count == b.count && a.minimum == b.minimum && a.maximum == b.maximum && a.mean == b.mean &&
               a.deviation == b.deviation && a.median == b.median && a.sum == b.sum;
    };
    for (const Mesh& mesh :
         {shapes::cube(), shapes::quad_cube(), l_prism(), shapes::grid(3, 3), shapes::fan3(),
          shapes::icosphere(2), Mesh{}, placed(shapes::torus(9, 7), {1e-200, 1e-200, 1e-200}, {})}) {
        const EdgeSettings settings{.feature_angle = 0.1};
        std::size_t before = allocations_of_thread();
        const EdgeResult edges = measure_edges(mesh, settings);
        const CurvatureResult curvature = measure_curvature(mesh);
        const std::size_t apart = allocations_of_thread() - before;
        before = allocations_of_thread();
        const EdgesAndCurvature both = measure_edges_and_curvature(mesh, settings);
        const std::size_t together = allocations_of_thread() - before;
        CHECK((same(both.edges.length, edges.length) && same(both.edges.turn, edges.turn)));
        CHECK(both.edges.convex == edges.convex);
        CHECK(both.edges.feature == edges.feature);
        CHECK(both.edges.boundary == edges.boundary);
        CHECK(both.edges.non_manifold == edges.non_manifold);
        CHECK((same(both.curvature.of_gaussian, curvature.of_gaussian) &&
               same(both.curvature.of_mean, curvature.of_mean)));
        CHECK(both.curvature.total == curvature.total);
        CHECK(both.curvature.mean.size() == mesh.vertex_count());
        if (mesh.face_count() > 0 && mesh.all_triangles()) CHECK(together + 15 < apart);
    }
}

namespace {

/// The corners in a plane of normal (1, 2, 2) / 3, at a distance from the origin.
std::vector<Vec3> tilted(const std::vector<Vec2>& flat, double away) {
    const Vec3 u = Vec3{2, 1, -2} / 3, v = Vec3{-2, 2, -1} / 3, n = Vec3{1, 2, 2} / 3;
    std::vector<Vec3> corners;
    for (const Vec2& p : flat) corners.push_back(n * away + u * p.x + v * p.y);
    return corners;
}

std::vector<Vec3> level(const std::vector<Vec2>& flat, double z, double size = 1) {
    std::vector<Vec3> corners;
    for (const Vec2& p : flat) corners.push_back({p.x * size, p.y * size, z * size});
    return corners;
}

void check_moments(const polygon::SecondMoments& m, double x, double y, double xy) {
    CHECK(m.x == Approx(x).epsilon(1e-13));
    CHECK(m.y == Approx(y).epsilon(1e-13));
    CHECK(m.xy == Approx(xy).epsilon(1e-13).margin(1e-13));
}

} // namespace

TEST_CASE("second moments of a rectangle, a right triangle and an L are those of the textbook",
          "[geometry]") {
    const auto rectangle =
        measure_polygon(level({{10, 20}, {12, 20}, {12, 23}, {10, 23}}, 5)); // b = 2, h = 3
    check_moments(rectangle.moments->about_centroid, 4.5, 2, 0);             // b h^3 / 12
    check_moments(rectangle.moments->about_origin, 4.5 + 6 * 21.5 * 21.5, 2 + 6 * 121, 6 * 11 * 21.5);
    CHECK(rectangle.moments->axes.largest == Approx(4.5));
    check_close(rectangle.frame.direction(rectangle.moments->axes.major), {1, 0, 0});
    const auto triangle = measure_polygon(level({{0, 0}, {3, 0}, {0, 2}}, -1));
    check_moments(triangle.moments->about_origin, 2, 4.5, 1.5);                  // b h^3 / 12, b^2 h^2 / 24
    check_moments(triangle.moments->about_centroid, 24.0 / 36, 1.5, -36.0 / 72); // b h^3 / 36, -b^2 h^2 / 72
    const auto bent = measure_polygon(level({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 0));
    check_moments(bent.moments->about_origin, 3, 3, 1.75); // three unit squares
    CHECK(bent.kind == polygon::Kind::concave);
    check_close(bent.centroid, {5.0 / 6, 5.0 / 6, 0});
}

TEST_CASE("the signed area of a polygon has the sense of its corners, its moments do not", "[geometry]") {
    const std::vector<Vec2> ring{{1, 1}, {4, 1}, {4, 3}, {1, 2}};
    std::vector<Vec2> back(ring.rbegin(), ring.rend());
    const auto up = measure_polygon(level(ring, 0)), down = measure_polygon(level(back, 0));
    CHECK(up.signed_area == Approx(4.5));
    CHECK(down.signed_area == Approx(-4.5));
    CHECK((up.area == Approx(4.5) && down.area == Approx(4.5)));
    CHECK(down.moments->about_origin.xy == Approx(up.moments->about_origin.xy));
    CHECK(up.normal == Vec3{0, 0, 1});
    CHECK(down.normal == Vec3{0, 0, -1});
}

TEST_CASE("principal moments of a polygon are the same wherever its plane is", "[geometry]") {
    const double h = std::sqrt(3.0) / 2;
    const std::vector<Vec2> hexagon{{1, 0}, {0.5, h}, {-0.5, h}, {-1, 0}, {-0.5, -h}, {0.5, -h}};
    const double each = 5 * std::sqrt(3.0) / 16; // of a regular hexagon of circumradius 1, about any axis
    for (const auto& corners : {level(hexagon, 7), tilted(hexagon, 0), tilted(hexagon, 1e4)}) {
        const auto r = measure_polygon(corners);
        CHECK(r.kind == polygon::Kind::convex);
        CHECK(r.planar);
        CHECK(r.moments->axes.largest == Approx(each).epsilon(1e-10));
        CHECK(r.moments->axes.smallest == Approx(each).epsilon(1e-10));
    }
    const auto strip = measure_polygon(tilted({{0, 0}, {4, 0}, {4, 1}, {0, 1}}, 3)); // long along u
    CHECK(strip.moments->axes.largest == Approx(64.0 / 12));
    CHECK(strip.moments->axes.smallest == Approx(4.0 / 12));
    const Vec3 across = strip.frame.direction(strip.moments->axes.major); // its largest moment is about v
    check_close(across * (across.y > 0 ? 1 : -1), Vec3{-2, 2, -1} / 3, 1e-13);
}

TEST_CASE("a polygon that crosses itself is measured by what it winds around", "[geometry]") {
    const std::vector<Vec2> eight{{0, 0}, {2, 2}, {2, 0}, {0, 2}}; // two triangles of base 2, height 1
    for (const auto& corners : {level(eight, 3), tilted(eight, 0), tilted(eight, 1e3)}) {
        const auto r = measure_polygon(corners);
        CHECK(r.kind == polygon::Kind::self_intersecting);
        CHECK(r.planar);
        CHECK(r.area == Approx(2).epsilon(1e-13));
        CHECK(r.signed_area == r.area); // as much either way
        CHECK(length(r.normal - r.frame.normal) == 0);
        check_close(r.centroid, (corners[0] + corners[1] + corners[2] + corners[3]) / 4, 1e-12);
        CHECK(r.moments->axes.largest == Approx(1).epsilon(1e-10));
        CHECK(r.moments->axes.smallest == Approx(1.0 / 3).epsilon(1e-10));
    }
    check_moments(measure_polygon(level(eight, 3)).moments->about_centroid, 1.0 / 3, 1, 0);
    check_moments(measure_polygon(level(eight, 3)).moments->about_origin, 2 + 1.0 / 3, 2 + 1, 2);
    const std::vector<Vec2> uneven{{0, 0}, {6, 0}, {2, 4}, {4, 4}}; // 9 anticlockwise, 1 clockwise
    const std::vector<Vec2> back(uneven.rbegin(), uneven.rend());
    CHECK(measure_polygon(level(uneven, 0)).signed_area == Approx(10));
    CHECK(measure_polygon(level(back, 0)).signed_area == Approx(-10));
    CHECK(measure_polygon(level(back, 0)).normal == Vec3{0, 0, -1});
    check_close(measure_polygon(level(back, 0)).centroid, Vec3{3, (9.0 * 1 + 1.0 * (4 - 1.0 / 3)) / 10, 0},
                1e-13);
    const auto star = test::pentagram(); // its middle is wound around twice, and counts once
    const double middle = 2.5 * std::sin(2 * pi / 5) * std::pow((3 - std::sqrt(5.0)) / 2, 2);
    CHECK(measure_polygon(level(star, 0)).area == Approx(polygon::signed_area(star) - middle));
}

TEST_CASE("faces that cross themselves have their area in sums, too, and their volume by winding",
          "[geometry]") {
    const std::vector<Vec2> uneven{{0, 0}, {6, 0}, {2, 4}, {4, 4}};
    Mesh prism;
    for (const double z : {0.0, 1.0})
        for (const Vec2& p : uneven) prism.positions.push_back({p.x, p.y, z});
    add_face(prism, std::vector<Index>{3, 2, 1, 0});
    add_face(prism, std::vector<Index>{4, 5, 6, 7});
    CHECK(measure_mass(prism).shell.area == Approx(20));
    check_close(measure_mass(prism).shell.centroid, {3, 19.0 / 15, 0.5}, 1e-13);
    const auto faces = measure_faces(prism);
    CHECK(faces.areas[0] == Approx(10));
    CHECK(faces.area.sum == Approx(20));
    const Mesh floor = [&] {
        Mesh m;
        m.positions = prism.positions;
        add_face(m, std::vector<Index>{4, 5, 6, 7});
        return m;
    }();
    const auto sheet = eigen(inertia_of(measure_mass(floor).shell.spread)).values;
    const auto axes = measure_polygon(level(uneven, 1)).moments->axes;
    CHECK(sheet[0] == Approx(axes.smallest));
    CHECK(sheet[1] == Approx(axes.largest));
    for (Index i = 0; i < 4; ++i) add_face(prism, std::vector<Index>{i, (i + 1) % 4, (i + 1) % 4 + 4, i + 4});
    CHECK(measure_mass(prism).solid->volume == Approx(9 - 1));
}

TEST_CASE("a polygon that crosses itself in no plane, or has no area, has no second moments", "[geometry]") {
    const auto bow = measure_polygon(std::vector<Vec3>{{0, 0, 0}, {2, 2, 0}, {2, 0, 0.5}, {0, 1, 0}});
    CHECK(bow.kind == polygon::Kind::self_intersecting);
    CHECK_FALSE(bow.planar);
    CHECK_FALSE(bow.moments);
    const auto line = measure_polygon(level({{0, 0}, {1, 1}, {3, 3}}, 0));
    CHECK(line.kind == polygon::Kind::degenerate);
    CHECK((line.area == 0 && line.signed_area == 0));
    CHECK_FALSE(line.moments);
    const auto bent = measure_polygon(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}});
    CHECK_FALSE(bent.planar);
    CHECK(bent.moments);
}

TEST_CASE("polygons far from 1 in size have moments as long as numbers hold them", "[geometry]") {
    const std::vector<Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (const double size : {1e-60, 1e-40, 1e40, 1e60}) {
        const auto r = measure_polygon(level(square, 1, size));
        CHECK(r.kind == polygon::Kind::quad);
        CHECK(r.moments->about_centroid.x / (size * size) / (size * size) == Approx(1.0 / 12));
        CHECK(r.moments->about_origin.xy / (size * size) / (size * size) == Approx(0.25));
        CHECK(r.signed_area / size / size == Approx(1));
    }
    CHECK(std::isinf(measure_polygon(level(square, 1, 1e90)).moments->about_centroid.x));
}

TEST_CASE("a shell has the moments of a sheet", "[geometry]") {
    const auto moments = [](const ShellMass& shell) { return eigen(inertia_of(shell.spread)).values; };
    const Mesh sheet = placed(shapes::grid(2, 3), {1, 1, 1}, {100, -50, 7});
    const auto flat = moments(measure_mass(sheet).shell); // b = 2, h = 3: 2, 4.5 and the polar one
    CHECK(flat[0] == Approx(2).epsilon(1e-12));
    CHECK(flat[1] == Approx(4.5).epsilon(1e-12));
    CHECK(flat[2] == Approx(6.5).epsilon(1e-12));
    for (const Mesh& cube : {shapes::cube(), shapes::quad_cube()})
        for (const double m : moments(measure_mass(cube).shell))
            CHECK(m == Approx(5.0 / 3).epsilon(1e-13)); // 5/18 of mass times side squared
    CHECK(moments(measure_mass(shapes::icosphere(5)).shell)[1] == Approx(8 * pi / 3).epsilon(0.01));
    const auto left = measure_mass(shapes::grid(1, 3)).shell,
               right = measure_mass(placed(shapes::grid(1, 3), {1, 1, 1}, {1, 0, 0})).shell;
    CHECK(moments(joined(left, right))[0] == Approx(2).epsilon(1e-13));
    const auto tiny = measure_mass(placed(shapes::grid(2, 3), {1e-40, 1e-40, 1e-40}, {})).shell;
    CHECK(tiny.spread.yy * 1e80 * 1e80 == Approx(4.5));
}

TEST_CASE("signed areas of the faces add up to the projections", "[geometry]") {
    const Vec3 of_l = measure_faces(l_prism()).signed_area;
    CHECK(length(of_l) < 1e-14);
    const Vec3 sheet = measure_faces(shapes::grid(4, 2)).signed_area;
    CHECK((sheet.x == 0 && sheet.y == 0));
    CHECK(std::abs(sheet.z) == measure_mass(shapes::grid(4, 2)).shell.area);
}

TEST_CASE("statistics leave out what is no number", "[geometry]") {
    const Statistics s = statistics({4, std::numeric_limits<double>::quiet_NaN(), 1, 2, 3, HUGE_VAL});
    CHECK(s.count == 4);
    CHECK((s.minimum == 1 && s.maximum == 4 && s.mean == 2.5 && s.median == 3 && s.sum == 10));
    CHECK(s.deviation == Approx(std::sqrt(1.25)));
    CHECK(statistics({}).count == 0);
}

TEST_CASE("measures are the same for any number of threads", "[geometry]") {
    const Mesh mesh = test::noisy_icosphere(5, 0.1, 2);
    const auto many = measure_mass(mesh);
    const auto bent = measure_curvature(mesh);
    set_threads(1);
    CHECK(inertia_of(measure_mass(mesh).solid->spread).xy == inertia_of(many.solid->spread).xy);
    CHECK(measure_curvature(mesh).total == bent.total);
    set_threads(0);
}
