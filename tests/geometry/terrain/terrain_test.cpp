#include "support/catch.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/terrain/terrain.hpp"
#include "mesh/shapes.hpp"
#include "parallel/parallel.hpp"

#include <functional>

using namespace facetmill;

namespace terrain_test {

namespace {

using Height = std::function<double(double, double)>;

/// A grid of n x n squares over a square, with these heights at its corners.
Mesh terrain(int n, double low, double high, const Height& height) {
    Mesh mesh = shapes::grid(n, n);
    for (Vec3& p : mesh.positions) {
        const double x = low + (high - low) * p.x / n, y = low + (high - low) * p.y / n;
        p = {x, y, height(x, y)};
    }
    return mesh;
}

VolumeResult between(const Mesh& mesh, const VolumeSettings& settings) {
    return volume_between(surface_of(mesh), settings);
}
VolumeResult between_two(const Mesh& mesh, const Mesh& other) {
    const Surface surface = surface_of(other);
    return between(mesh, {.other = &surface});
}

/// Exact, up to the rounding of sums.
Approx near(double value) { return Approx(value).epsilon(1e-12).margin(1e-12); }

/// A pyramid over a regular polygon, without its base.
Mesh pyramid(int corners, double radius, double height) {
    Mesh mesh;
    mesh.positions.push_back({0, 0, height});
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * 3.14159265358979323846 * i / corners;
        mesh.positions.push_back({radius * cosine(angle), radius * sine(angle), 0});
        const auto a = static_cast<Index>(i + 1), b = static_cast<Index>((i + 1) % corners + 1);
        mesh.corners.insert(mesh.corners.end(), {0, a, b});
    }
    return mesh;
}

/// A strip along y that folds back over itself: z = 0 for x < 3, then up to (2, 1), then z = 1.
Mesh fold() {
    Mesh mesh;
    for (const auto& [x, z] : {std::pair{0.0, 0.0}, {3.0, 0.0}, {2.0, 1.0}, {4.0, 1.0}})
        for (const double y : {0.0, 1.0}) mesh.positions.push_back({x, y, z});
    for (Index i = 0; i < 3; ++i)
        for (const Index c : {0, 2, 1, 1, 2, 3}) mesh.corners.push_back(2 * i + c);
    return mesh;
}

void turn_over(Mesh& mesh, std::size_t face) {
    std::swap(mesh.corners[3 * face], mesh.corners[3 * face + 1]);
}

} // namespace

TEST_CASE("the volume of a wedge over a level is that of its prisms", "[geometry]") {
    const Mesh wedge = terrain(4, 0, 4, [](double x, double) { return x; });
    const VolumeResult r = between(wedge, {.level = 2});
    CHECK(r.cover == Cover::once);
    CHECK(r.above.volume == near(8));
    CHECK(r.below.volume == near(8));
    CHECK(r.above.area == near(8));
    CHECK(r.below.area == near(8));
    CHECK(r.above.deepest == 2);
    CHECK(r.below.mean() == near(1));
    CHECK(r.compared == near(16));
    CHECK(r.footprint == near(16));
    CHECK(r.missing == 0);
    const VolumeResult flat = between(terrain(3, 0, 3, [](double, double) { return 2; }), {.level = 2});
    CHECK(flat.level == near(9));
    CHECK(flat.above.area + flat.below.area == 0);
}

TEST_CASE("the volume of a cone over levels is that of smaller cones", "[geometry]") {
    for (const int corners : {3, 7, 64}) {
        const double radius = 2, height = 3;
        const double area = corners * radius * radius * sine(2 * 3.14159265358979323846 / corners) / 2;
        const double whole = area * height / 3;
        const Mesh cone = pyramid(corners, radius, height);
        CHECK(between(cone, {}).above.volume == near(whole));
        const VolumeResult half = between(cone, {.level = height / 2});
        CHECK(half.above.volume == near(whole / 8));
        CHECK(half.above.area == near(area / 4));
        CHECK(half.below.volume == near(area * height / 2 + whole / 8 - whole));
        CHECK(half.above.deepest == near(height / 2));
    }
}

TEST_CASE("the volume of a piecewise linear paraboloid is the sum over its grid", "[geometry]") {
    const int n = 20;
    const Mesh bowl = terrain(n, -1, 1, [](double x, double y) { return x * x + y * y; });
    // Linear interpolation of x^2 in steps s adds s^2 / 6 to its mean.
    const double s = 2.0 / n, volume = 8.0 / 3 + 4 * 2 * s * s / 6;
    CHECK(between(bowl, {}).above.volume == near(volume));
    CHECK(between(bowl, {.level = 3}).below.volume == near(3 * 4 - volume));
    const Mesh other = terrain(13, -1, 1, [](double x, double y) { return 2 - x * x - y * y; });
    const double t = 2.0 / 13, above = volume - (8 - 8.0 / 3 - 4 * 2 * t * t / 6);
    const VolumeResult there = between_two(bowl, other), back = between_two(other, bowl);
    CHECK(there.above.volume - there.below.volume == near(above));
    CHECK(there.above.volume == near(back.below.volume));
    CHECK(there.below.volume == near(back.above.volume));
    CHECK(there.above.area == near(back.below.area));
    CHECK(there.compared == near(4));
}

TEST_CASE("the volume between two surfaces does not depend on their triangles or place", "[geometry]") {
    const double x0 = 500608, y0 = 5200512, z0 = 384; // far away, as in UTM
    const auto moved = [&](Mesh mesh) {
        for (Vec3& p : mesh.positions) p += Vec3{x0, y0, z0};
        return mesh;
    };
    const Mesh ground = moved(terrain(8, 0, 4, [](double x, double) { return x / 2; }));
    const Mesh design = moved(terrain(3, -1, 5, [](double, double y) { return y / 4 + 1; }));
    const VolumeResult r = between_two(ground, design);
    CHECK(r.above.volume == near(4.0 / 3));
    CHECK(r.below.volume == near(28.0 / 3));
    CHECK(r.above.area == near(4));
    CHECK(r.below.area == near(12));
    CHECK(r.missing_in_other == 0);
    const Footprint part({{{x0 + 1, y0 + 1}, {x0 + 3, y0 + 1}, {x0 + 3, y0 + 4}, {x0 + 1, y0 + 4}}});
    const Surface other = surface_of(design);
    const VolumeResult inside = volume_between(surface_of(ground), {.other = &other, .footprint = &part});
    // The mean of x / 2 - y / 4 - 1 over the rectangle is -0.625.
    CHECK(inside.above.volume - inside.below.volume == near(-0.625 * 6));
    CHECK(inside.compared == near(6));
    CHECK(inside.footprint == near(6));
}

TEST_CASE("a footprint with a hole and slanted edges cuts the volume", "[geometry]") {
    const Mesh wedge = terrain(5, 0, 5, [](double x, double) { return x; });
    const Footprint footprint({{{0.5, 0.5}, {3.5, 0.5}, {3.5, 2.5}}, {{2.5, 0.75}, {3, 0.75}, {3, 1.25}}});
    const VolumeResult r = between(wedge, {.footprint = &footprint});
    const double hole = 0.125;
    CHECK(r.above.volume == near(3 * 2.5 - hole * (8.5 / 3)));
    CHECK(r.compared == near(3 - hole));
    CHECK(r.missing == 0);
    const Footprint beyond({{{4, 1}, {7, 1}, {7, 2}, {4, 2}}});
    const VolumeResult half = between(wedge, {.footprint = &beyond});
    CHECK(half.above.volume == near(4.5));
    CHECK(half.missing == near(2));
    CHECK(half.footprint == near(3));
}

TEST_CASE("holes of a terrain have no volume, and their area is given", "[geometry]") {
    Mesh mesh = terrain(4, 0, 4, [](double, double) { return 1; });
    mesh.corners.erase(mesh.corners.begin() + 30, mesh.corners.begin() + 36);
    const Footprint all({{{0, 0}, {4, 0}, {4, 4}, {0, 4}}});
    const VolumeResult r = between(mesh, {.footprint = &all});
    CHECK(r.above.volume == near(15));
    CHECK(r.missing == near(1));
    const Mesh whole = terrain(3, 0, 4, [](double, double) { return 0; });
    CHECK(between_two(whole, mesh).missing_in_other == near(1));
    CHECK(between_two(whole, mesh).below.volume == near(15));
}

TEST_CASE("the orientation of a terrain does not matter", "[geometry]") {
    Mesh mesh = terrain(6, 0, 6, [](double x, double y) { return x * y / 8; });
    const double volume = between(mesh, {.level = 1}).above.volume;
    for (std::size_t f = 0; f < mesh.face_count(); f += 3) turn_over(mesh, f);
    const VolumeResult mixed = between(mesh, {.level = 1});
    CHECK(mixed.cover == Cover::once);
    CHECK(mixed.above.volume == near(volume));
    CHECK(mixed.missing == 0);
}

TEST_CASE("an overhanging surface counts once, if it is oriented", "[geometry]") {
    Mesh mesh = fold();
    const VolumeResult r = between(mesh, {});
    CHECK(r.cover == Cover::overhangs);
    CHECK(r.above.volume == near(1.5));
    CHECK(r.below.volume == near(0));
    CHECK(r.compared == near(4));
    CHECK(between(mesh, {.level = 1}).below.volume == near(2.5));
    const Mesh slope = terrain(2, -1, 5, [](double x, double) { return (x - 4) / 2; });
    // Below the slope's part above 0 is nothing of the fold, as that ends at x = 4.
    CHECK(between_two(mesh, slope).above.volume == near(1.5 + 4));
    for (std::size_t f = 0; f < mesh.face_count(); ++f) turn_over(mesh, f);
    CHECK(between(mesh, {}).above.volume == near(1.5));
    turn_over(mesh, 2);
    turn_over(mesh, 3);
    const VolumeResult sheets = between(mesh, {});
    CHECK(sheets.cover == Cover::several);
    REQUIRE(sheets.doubled);
    CHECK(sheets.doubled->x > 2);
    CHECK(sheets.doubled->x < 3);
}

TEST_CASE("a closed solid has volumes above and below a level", "[geometry]") {
    Mesh cube = shapes::cube();
    const auto check = [&] {
        const VolumeResult r = between(cube, {.level = 0.25});
        CHECK(r.cover == Cover::solid);
        CHECK(r.above.volume == near(0.75));
        CHECK(r.below.volume == near(0.25));
    };
    check();
    for (std::size_t f = 0; f < cube.face_count(); ++f) turn_over(cube, f);
    check();
}

TEST_CASE("tiles of a terrain may overlap by slivers", "[geometry]") {
    Mesh mesh = terrain(2, 0, 3, [](double, double) { return 1; });
    Mesh fine = terrain(7, 0, 3, [](double, double) { return 1; });
    for (Vec3& p : fine.positions) p.x += 3 - (p.y > 0.4 && p.y < 2 ? 1e-9 : 0);
    append(mesh, fine);
    const VolumeResult r = between(mesh, {});
    CHECK(r.cover == Cover::once);
    CHECK(r.doubled_area > 0);
    CHECK(r.above.volume == Approx(18).epsilon(1e-8));
}

TEST_CASE("terrains can be seen along any axis, by any number of threads", "[geometry]") {
    const Mesh ground = terrain(40, 0, 4, [](double x, double y) { return x * x - y; });
    const VolumeResult along_z = between(ground, {.level = 1});
    for (const std::size_t axis : {0, 1}) {
        Mesh turned = ground;
        for (Vec3& p : turned.positions) p = axis == 0 ? Vec3{p.z, p.x, p.y} : Vec3{p.x, p.z, p.y};
        CHECK(between(turned, {.axis = axis, .level = 1}).above.volume == along_z.above.volume);
    }
    set_threads(3);
    CHECK(between(ground, {.level = 1}).below.volume == along_z.below.volume);
    set_threads(0);
}

} // namespace terrain_test
