#include "geometry/generate/generate.hpp"

#include "geometry/inspect/inspect.hpp"
#include "mesh/invariants.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/surface.hpp"

using namespace facetmill;

namespace {

constexpr double exact_pi = 3.14159265358979323846;

GenerateSettings of(Shape shape) {
    GenerateSettings s;
    s.shape = shape;
    return s;
}

} // namespace

TEST_CASE("closed shapes are sound and have their Euler number", "[geometry]") {
    for (const bool quads : {false, true}) {
        const auto sound = [&](GenerateSettings s, std::int64_t euler) {
            s.quads = quads;
            const Mesh mesh = generate(s);
            CHECK(broken_invariants(mesh).empty());
            CHECK(mesh.face_count() <= generate_face_estimate(s));
            CHECK((quads || static_cast<double>(mesh.face_count()) == generate_face_estimate(s)));
            CHECK(*inspect(mesh).volume > 0);
            return test::sound(mesh, euler);
        };
        GenerateSettings s = of(Shape::cylinder);
        s.rings = 3;
        CHECK(sound(s, 2));
        s.shape = Shape::cone;
        CHECK(sound(s, 2));
        s.shape = Shape::sphere;
        CHECK(sound(s, 2));
        s.shape = Shape::torus;
        CHECK(sound(s, 0));
        CHECK(sound(of(Shape::icosphere), 2));
        CHECK(sound(of(Shape::cube), 2));
    }
}

TEST_CASE("bands of a sphere: the nearest number that well-shaped ones give, by trying all", "[geometry]") {
    const auto nearest = [](std::int64_t faces) {
        std::int64_t best = 1 << 30;
        for (std::int64_t rings = 2; rings * rings <= 4 * faces + 99; ++rings)
            for (std::int64_t segments = std::max<std::int64_t>(3, rings); segments <= 4 * rings;
                 ++segments) {
                const std::int64_t count = 2 * segments * (rings - 1), miss = std::abs(count - faces),
                                   least = std::abs(best - faces);
                if (miss < least || (miss == least && count < best)) best = count;
            }
        return best;
    };
    const auto made = [](std::int64_t faces) {
        const SphereBands b = sphere_bands(faces);
        CHECK(b.segments >= std::max<std::int64_t>(3, b.rings));
        CHECK(b.segments <= 4 * b.rings);
        return 2 * b.segments * (b.rings - 1);
    };
    for (std::int64_t faces = 6; faces < 1500; ++faces) {
        CAPTURE(faces);
        CHECK(made(faces) == nearest(faces));
    }
    for (const std::int64_t faces : {4000, 4001, 9999, 19881, 40000}) CHECK(made(faces) == nearest(faces));
    CHECK(made(4001) == 4000);
    CHECK(made(19881) == 19880);
    CHECK(std::abs(made(700000000) - 700000000) < 1000);
}

TEST_CASE("a sphere of 4000 faces", "[geometry]") {
    CHECK(sphere_bands(4000).segments == 80);
    CHECK(sphere_bands(4000).rings == 26);
    GenerateSettings s = of(Shape::sphere);
    s.segments = 80;
    s.rings = 26;
    s.radius = 3;
    const Mesh mesh = generate(s);
    CHECK(mesh.face_count() == 4000);
    for (const Vec3& p : mesh.positions) CHECK(length(p) == Approx(3).epsilon(1e-14));
}

TEST_CASE("cylinder and cone: their volumes, and open without caps", "[geometry]") {
    GenerateSettings s = of(Shape::cylinder);
    s.radius = 2;
    s.height = 5;
    s.segments = 1000;
    s.rings = 4;
    CHECK(*inspect(generate(s)).volume == Approx(exact_pi * 4 * 5).epsilon(1e-4));
    s.shape = Shape::cone;
    CHECK(*inspect(generate(s)).volume == Approx(exact_pi * 4 * 5 / 3).epsilon(1e-4));
    s.segments = 12;
    s.caps = false;
    CHECK(inspect(generate(s)).boundary_loops == 1);
    s.shape = Shape::cylinder;
    CHECK(inspect(generate(s)).boundary_loops == 2);
}

TEST_CASE("a gaussian has its height, its spread and its square", "[geometry]") {
    GenerateSettings s = of(Shape::gaussian);
    s.size = 4;
    s.height = 3;
    s.spread = 0.5;
    s.cells = 8;
    const Mesh mesh = generate(s);
    CHECK(mesh.vertex_count() == 81);
    CHECK(mesh.positions[40] == Vec3{0, 0, 3});
    CHECK(mesh.positions[41].x == 0.5);
    CHECK(mesh.positions[41].z == Approx(3 * std::exp(-0.5)));
    CHECK(mesh.bounds().min.x == -2);
    CHECK(mesh.bounds().max.y == 2);
}

TEST_CASE("the Menger sponge has only its outer surface", "[geometry]") {
    GenerateSettings s = of(Shape::menger);
    s.quads = true;
    const std::size_t faces[] = {72, 1056, 18048};
    const double volumes[] = {20.0 / 27, 400.0 / 729, 8000.0 / 19683};
    for (int level = 1; level <= 3; ++level) {
        s.subdivisions = level;
        s.size = 1;
        const Mesh mesh = generate(s);
        CHECK(mesh.face_count() == faces[level - 1]);
        const Properties p = inspect(mesh);
        CHECK((p.closed && p.edge_manifold && p.vertex_manifold && p.oriented));
        CHECK(*p.volume == Approx(volumes[level - 1]).epsilon(1e-12));
        CHECK(p.components == 1);
    }
    s.subdivisions = 1;
    CHECK(inspect(generate(s)).genus == 5);
}

TEST_CASE("noise moves every vertex, the same for the same seed", "[geometry]") {
    GenerateSettings s = of(Shape::gaussian);
    const Mesh smooth = generate(s);
    s.noise = 0.01;
    s.seed = 5;
    const Mesh noisy = generate(s);
    CHECK(test::same(noisy, generate(s)));
    double sum = 0;
    for (std::size_t v = 0; v < smooth.vertex_count(); ++v) {
        const Vec3 d = noisy.positions[v] - smooth.positions[v];
        CHECK((d.x != 0 && d.y != 0 && d.z != 0));
        sum += dot(d, d);
    }
    CHECK(std::sqrt(sum / 3 / static_cast<double>(smooth.vertex_count())) == Approx(0.01).epsilon(0.1));
}

TEST_CASE("shapes out of range are refused", "[geometry]") {
    GenerateSettings s = of(Shape::torus);
    s.minor_radius = 1;
    CHECK(test::failure([&] { generate(s); }) ==
          "usage [E-RANGE] generate: minor_radius must be below the radius 1, not 1 | use a smaller "
          "minor_radius or a larger radius");
    s = of(Shape::sphere);
    s.radius = 1e300;
    CHECK(test::failure([&] { generate(s); }) ==
          "usage [E-RANGE] generate: radius must be at most 1e+37, because files hold float32, not 1e+300 | "
          "use a smaller length, or a larger unit");
    s = of(Shape::menger);
    s.subdivisions = 5;
    CHECK(test::failure([&] { generate(s); }) == "usage [E-RANGE] generate: subdivisions is 1 to 4, not 5");
    s = of(Shape::sphere);
    s.rings = 1;
    CHECK(test::failure([&] { generate(s); }) == "usage [E-RANGE] generate: rings is at least 2, not 1");
    s.rings = 1 << 20;
    s.segments = 1 << 20;
    CHECK(test::failure([&] { generate(s); }) ==
          "limit [E-LIMIT] generate: the shape would have about 2.2e+12 faces, but at most 7.16e+08 are "
          "possible | ask for fewer faces, cells or subdivisions");
}
