// Meshes near the limits of doubles. Scaling by powers of two rounds nothing. Results for the scaled mesh
// are therefore the same to the last bit, as long as they are finite.
#include "support/catch.hpp"
#include "support/meshes.hpp"

#include "geometry/deviation/deviation.hpp"
#include "geometry/edit/moved.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/measure/measure.hpp"
#include "geometry/orient/orient.hpp"
#include "geometry/polygon/polygon.hpp"
#include "geometry/spatial/rays.hpp"
#include "mesh/plane.hpp"
#include "mesh/power_scale.hpp"
#include "mesh/shapes.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

constexpr int powers[] = {-1070, -1000, -512, -340, -150, -101, 101, 150, 340, 511, 1000, 1020};

Mesh scaled(Mesh mesh, int x, int y, int z) {
    for (Vec3& p : mesh.positions) p = {std::ldexp(p.x, x), std::ldexp(p.y, y), std::ldexp(p.z, z)};
    return mesh;
}
Mesh scaled(const Mesh& mesh, int power) { return scaled(mesh, power, power, power); }

/// Two crossing axis-aligned boxes with whole coordinates, so that the smallest scale loses no digits.
Mesh crossing_boxes() {
    Mesh a = shapes::cube(), b = shapes::cube();
    for (Vec3& p : a.positions) p *= 4;
    for (Vec3& p : b.positions) p = p * 4 + Vec3{1, 2, 3};
    append(a, b);
    return a;
}

void check_scaled(double is, double was, int power) {
    INFO(was << " times 2^" << power);
    CHECK(is == std::ldexp(was, power));
}

void check_scaled(const Statistics& is, const Statistics& was, int power) {
    CHECK(is.count == was.count);
    check_scaled(is.minimum, was.minimum, power);
    check_scaled(is.maximum, was.maximum, power);
    check_scaled(is.mean, was.mean, power);
    check_scaled(is.median, was.median, power);
    check_scaled(is.deviation, was.deviation, power);
}

} // namespace

TEST_CASE("area and volume of a cube are right at every size", "[geometry]") {
    for (const int k : powers) {
        const Properties p = inspect(scaled(shapes::cube(), k));
        check_scaled(p.area, 6, 2 * k);
        check_scaled(*p.volume, 1, 3 * k);
        CHECK((p.closed && p.degenerate_faces == 0 && p.euler == 2));
        const SurfaceSize size = surface_size(scaled(shapes::cube(), k));
        check_scaled(size.area, 6, 2 * k);
        check_scaled(*size.volume, 1, 3 * k);
    }
}

TEST_CASE("a needle longer than its square has a volume", "[geometry]") {
    const Mesh needle = scaled(shapes::cube(), 1000, -990, -5);
    CHECK(*inspect(needle).volume == 32);
    CHECK(inspect(needle).area ==
          std::ldexp(1, 996)); // two sides of 2^1000 by 2^-5; the others are negligible
    const auto mass = measure_mass(needle);
    CHECK(mass.solid->volume == 32);
    CHECK(mass.solid->centroid == Vec3{std::ldexp(0.5, 1000), std::ldexp(0.5, -990), std::ldexp(0.5, -5)});
}

TEST_CASE("one corner far away does not take the others' verdicts along", "[geometry]") {
    Mesh cube = shapes::cube();
    cube.positions[7].x = 1e307;
    const Properties p = inspect(cube, {.self_intersections = true});
    CHECK((p.closed && p.oriented && p.degenerate_faces == 0));
    CHECK(p.self_intersections == 0);
    CHECK(p.area > 1e307);
    CHECK(*p.volume > 1e306);
}

TEST_CASE("measures of a bumpy sphere scale exactly", "[geometry]") {
    Mesh bumpy = shapes::icosphere(2);
    for (std::size_t v = 0; v < bumpy.positions.size(); ++v)
        bumpy.positions[v] *= 1 + 0.001 * static_cast<double>(v % 7);
    const auto mass = measure_mass(bumpy);
    const auto edges = measure_edges(bumpy);
    const auto faces = measure_faces(bumpy);
    const auto bends = measure_curvature(bumpy);
    for (const int k : {-1000, -340, -101, 101, 340, 1000}) {
        const Mesh far = scaled(bumpy, k);
        const auto m = measure_mass(far);
        check_scaled(m.shell.area, mass.shell.area, 2 * k);
        check_scaled(m.shell.centroid.x, mass.shell.centroid.x, k);
        check_scaled(m.solid->volume, mass.solid->volume, 3 * k);
        check_scaled(m.solid->centroid.z, mass.solid->centroid.z, k);
        check_scaled(m.solid->spread.xx, mass.solid->spread.xx, 5 * k);
        check_scaled(m.solid->spread.yz, mass.solid->spread.yz, 5 * k);
        const auto e = measure_edges(far);
        check_scaled(e.length, edges.length, k);
        check_scaled(e.turn, edges.turn, 0);
        const auto f = measure_faces(far);
        check_scaled(f.area, faces.area, 2 * k);
        check_scaled(f.angle, faces.angle, 0);
        check_scaled(f.aspect_ratio, faces.aspect_ratio, 0);
        const auto c = measure_curvature(far);
        check_scaled(c.of_gaussian.median, bends.of_gaussian.median, -2 * k);
        check_scaled(c.of_mean.median, bends.of_mean.median, -k);
        check_scaled(c.total, bends.total, 0);
    }
}

TEST_CASE("angles, aspects and edge lengths scale exactly", "[geometry]") {
    const Mesh sphere = shapes::icosphere(2);
    for (const int k : {-1000, -340, 340, 1000}) {
        const Mesh far = scaled(sphere, k);
        const auto value = [](const Mesh& mesh, const char* name) {
            return measure(mesh, *property_named(name)).value();
        };
        for (const char* name : {"min_angle", "max_angle", "aspect_ratio"})
            CHECK(value(far, name) == value(sphere, name));
        for (const char* name : {"shortest_edge", "longest_edge", "max_extent"})
            check_scaled(value(far, name), value(sphere, name), k);
        const Mesh cone = shapes::open_cone(9);
        check_scaled(value(scaled(cone, k), "boundary_length"), value(cone, "boundary_length"), k);
    }
}

TEST_CASE("orient finds the outside at every size", "[geometry]") {
    Mesh cube = shapes::cube();
    flip_faces(cube, std::vector<std::uint8_t>(cube.face_count(), 1));
    Mesh cup = shapes::open_cone(12);
    const bool cup_turns = orient(cup, {}).flipped > 0;
    for (const int k : powers) {
        const auto r = orient(scaled(cube, k), {});
        CHECK(r.flipped == cube.face_count());
        CHECK_FALSE(r.components.at(0).undecided);
        CHECK(*inspect(scaled(r.mesh, -k)).volume == 1);
        if (k < -1000) continue; // the cone's corners are no whole numbers
        CHECK((orient(scaled(cup, k), {}).flipped > 0) == cup_turns);
    }
}

TEST_CASE("faces that meet are found at every size, and points within", "[geometry]") {
    const Mesh boxes = crossing_boxes();
    const auto pairs = find_self_intersections(boxes, {.limit = 100}).pairs;
    CHECK(pairs.size() == 14);
    for (const int k : powers) {
        CAPTURE(k);
        const Mesh far = scaled(boxes, k);
        CHECK(find_self_intersections(far, {.limit = 100}).pairs == pairs);
        const FaceTree tree(surface_of(far), FaceTree::Use::all);
        const auto at = [&](double x, double y, double z) {
            return Vec3{std::ldexp(x, k), std::ldexp(y, k), std::ldexp(z, k)};
        };
        CHECK(winding(tree, at(1, 1, 2)) == 1);
        CHECK(winding(tree, at(2, 3, 3.5)) == 2);
        CHECK(winding(tree, at(6, 1, 1)) == 0);
        CHECK(lies_on(tree, at(4, 1, 1)));
        CHECK_FALSE(lies_on(tree, at(3, 1, 1)));
    }
}

TEST_CASE("polygons turn the right way at every size", "[geometry]") {
    const Vec2 arrow[] = {{0, 0}, {4, 0}, {1, 1}, {0, 4}};
    for (const int k : powers) {
        std::vector<Vec2> ring;
        for (const auto& p : arrow) ring.push_back({std::ldexp(p.x, k), std::ldexp(p.y, k)});
        CHECK(polygon::orientation(ring) == 1);
        std::reverse(ring.begin(), ring.end());
        CHECK(polygon::orientation(ring) == -1);
        const std::vector<Vec2> flat{ring[0], ring[3], ring[0], ring[3]};
        CHECK(polygon::orientation(flat) == 0);
    }
}

TEST_CASE("deviation scales exactly", "[geometry]") {
    const Mesh a = shapes::icosphere(2), b = shapes::icosphere(1);
    const DeviationSettings settings{.samples = 500, .certify = true};
    const auto near = deviation(a, b, settings);
    for (const int k : {-1000, -340, 340, 1000}) {
        const auto far = deviation(scaled(a, k), scaled(b, k), settings);
        check_scaled(far.maximum(), near.maximum(), k);
        check_scaled(far.rms(), near.rms(), k);
        check_scaled(*far.bound(), *near.bound(), k);
        check_scaled(far.diagonal, near.diagonal, k);
        CHECK(far.percent(far.maximum()) == near.percent(near.maximum()));
    }
}

TEST_CASE("the diagonal of a box is right where its square is none", "[geometry]") {
    for (const int k : powers) {
        Box box;
        box.add(Vec3{});
        box.add(Vec3{std::ldexp(2, k), std::ldexp(3, k), std::ldexp(6, k)});
        check_scaled(diagonal(box), 7, k);
    }
    constexpr double most = 1.7976931348623157e308;
    Box all;
    all.add(Vec3{-most, 0, 0});
    all.add(Vec3{most, 0, 0});
    CHECK(diagonal(all) == HUGE_VAL);
    CHECK(diagonal(Box{}) == 0);
}
