#include "base/math/predicates.hpp"
#include "geometry/hull/convex_parts.hpp"
#include "geometry/hull/hull.hpp"
#include "geometry/spatial/solid_grid.hpp"
#include "support/catch.hpp"

#include "mesh/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <set>

using namespace facetmill;

namespace {

constexpr std::size_t few_cells = 1 << 15; // few, so that the tests take little time

bool inside(const Mesh& convex, const Vec3& p) {
    for (Index f = 0; f < convex.face_count(); ++f)
        if (orientation_3d(convex.point(3 * f), convex.point(3 * f + 1), convex.point(3 * f + 2), p) > 0)
            return false;
    return true;
}

/// Whether every vertex, and points inside every face, are in the shape around one of the parts.
bool covers(const ConvexPartsResult& r, const Mesh& mesh, HullShape shape) {
    std::vector<Mesh> shapes;
    shapes.reserve(r.parts.size());
    for (const ConvexPart& part : r.parts)
        shapes.push_back(convex_hull(part.points, {shape, 0, r.margin}).mesh);
    const auto covered = [&](const Vec3& p) {
        return std::any_of(shapes.begin(), shapes.end(), [&](const Mesh& m) { return inside(m, p); });
    };
    if (!std::all_of(mesh.positions.begin(), mesh.positions.end(), covered)) return false;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Vec3 &a = mesh.point(3 * f), &b = mesh.point(3 * f + 1), &c = mesh.point(3 * f + 2);
        for (int i = 0; i <= 4; ++i)
            for (int j = 0; i + j <= 4; ++j)
                if (!covered(a + (b - a) * (i / 4.0) + (c - a) * (j / 4.0))) return false;
    }
    return true;
}

Mesh block(const Vec3& from, const Vec3& to) {
    Mesh mesh = shapes::cube();
    for (Vec3& p : mesh.positions)
        for (std::size_t k = 0; k < 3; ++k) p[k] = p[k] > 0 ? to[k] : from[k];
    return mesh;
}

double volume(const ConvexPartsResult& r) {
    double sum = 0;
    for (const ConvexPart& part : r.parts)
        sum += convex_hull(part.points, {HullShape::hull, 0, r.margin}).volume;
    return sum;
}

} // namespace

TEST_CASE("convex parts: an L becomes two boxes", "[geometry][convex-parts]") {
    Mesh mesh = block({0, 0, 0}, {4, 1, 1});
    append(mesh, block({0, 1, 0}, {1, 3, 1}));
    const ConvexPartsResult r = convex_parts(mesh, {8, 0.2, few_cells});
    CHECK(r.parts.size() == 2);
    CHECK(covers(r, mesh, HullShape::hull));
    CHECK(volume(r) == Approx(6).epsilon(0.1)); // the cut is within a cell of the inner corner
    for (const ConvexPart& part : r.parts) CHECK(part.concavity <= 0.2);
}

TEST_CASE("convex parts: a convex solid stays whole, and separate solids get a shape each",
          "[geometry][convex-parts]") {
    CHECK(convex_parts(shapes::icosphere(2), {8, 0.1, few_cells}).parts.size() == 1);
    Mesh mesh = block({0, 0, 0}, {1, 1, 1});
    append(mesh, block({3, 0, 0}, {4, 1, 1}));
    append(mesh, block({0, 3, 0}, {1, 4, 1}));
    const ConvexPartsResult r = convex_parts(mesh, {8, 0.1, few_cells});
    CHECK(r.parts.size() == 3);
    CHECK(volume(r) == Approx(3).epsilon(1e-4));
    CHECK(convex_parts(mesh, {1, 0.1, few_cells}).parts.size() == 1);
    CHECK(convex_parts(Mesh{}, {8, 0.1, few_cells}).parts.empty());
}

TEST_CASE("convex parts: shapes of crossing parts and open sheets contain them", "[geometry][convex-parts]") {
    Mesh soup = shapes::torus(24, 8);
    append(soup, block({0.5, 0.1, -0.3}, {1.5, 1.1, 0.7}));
    append(soup, shapes::moebius(12));
    soup = triangulated(soup);
    const ConvexPartsResult r = convex_parts(soup, {6, 0.2, few_cells});
    CHECK(r.parts.size() <= 6);
    for (const HullShape shape : {HullShape::hull, HullShape::box, HullShape::sphere, HullShape::capsule})
        CHECK(covers(r, soup, shape));
}

TEST_CASE("convex parts: distances of cells are exact", "[geometry][convex-parts]") {
    SolidGrid grid(surface_of(block({0, 0, 0}, {1, 1, 1})), 0.5, 1000);
    grid.measure_distances();
    const auto solid = [&](std::size_t i) { return grid.solid(i); };
    const auto cell = [&](std::size_t i) {
        const auto x = static_cast<std::size_t>(grid.cells()[0]),
                   y = static_cast<std::size_t>(grid.cells()[1]);
        return Cell{static_cast<std::int32_t>(i % x), static_cast<std::int32_t>(i / x % y),
                    static_cast<std::int32_t>(i / x / y)};
    };
    for (std::size_t i = 0; i < grid.count(); ++i) {
        std::int32_t least = INT32_MAX;
        for (std::size_t j = 0; j < grid.count(); ++j) {
            if (!solid(j)) continue;
            std::int32_t square = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::int32_t d = cell(i)[k] - cell(j)[k];
                square += d * d;
            }
            least = std::min(least, square);
        }
        CHECK(static_cast<std::int32_t>(grid.square_distance(i)) == least);
    }
}

TEST_CASE("hull: corners of simpler hulls differ in float32", "[geometry][convex-parts]") {
    const Mesh ball = shapes::icosphere(4);
    for (const std::size_t most : {128UL, 256UL, 512UL}) {
        const HullResult r = convex_hull(ball.positions, {HullShape::hull, most});
        std::set<std::array<float, 3>> corners;
        for (const Vec3& p : r.mesh.positions)
            corners.insert({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
        CHECK(corners.size() == r.mesh.positions.size());
        CHECK(corners.size() <= most);
        CHECK(corners.size() > most * 3 / 4);
        CHECK(r.volume < 1.06 * r.hull_volume);
    }
}
