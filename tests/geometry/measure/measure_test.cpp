#include "support/catch.hpp"
#include "support/measure.hpp"

#include "base/parallel.hpp"
#include "base/portable_math.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/measure/measure.hpp"
#include "geometry/thicken/thicken.hpp"
#include "mesh/shapes.hpp"
#include "support/meshes.hpp"

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
        const auto i = r.solid->inertia(); // V/12 (b^2 + c^2)
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
    // About the origin xx is 1/60 and xy 1/120; Steiner takes V/16 off both.
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
    const Mesh mesh = testing::noisy_torus(40, 20, 0.02, 3);
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
    CHECK(measure_curvature(shapes::grid(3, 3)).of_gaussian.count == 4); // those inside
    CHECK(measure_curvature(shapes::quad_cube()).total == Approx(4 * pi).epsilon(1e-13));
}

TEST_CASE("statistics leave out what is no number", "[geometry]") {
    const Statistics s = statistics({4, std::numeric_limits<double>::quiet_NaN(), 1, 2, 3, HUGE_VAL});
    CHECK(s.count == 4);
    CHECK((s.minimum == 1 && s.maximum == 4 && s.mean == 2.5 && s.median == 3 && s.sum == 10));
    CHECK(s.deviation == Approx(std::sqrt(1.25)));
    CHECK(statistics({}).count == 0);
}

TEST_CASE("measures are the same for any number of threads", "[geometry]") {
    const Mesh mesh = testing::noisy_icosphere(5, 0.1, 2);
    const auto many = measure_mass(mesh);
    const auto bent = measure_curvature(mesh);
    set_threads(1);
    CHECK(measure_mass(mesh).solid->inertia().xy == many.solid->inertia().xy);
    CHECK(measure_curvature(mesh).total == bent.total);
    set_threads(0);
}
