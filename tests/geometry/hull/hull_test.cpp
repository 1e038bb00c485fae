#include "support/catch.hpp"

#include "base/math/predicates.hpp"
#include "geometry/hull/hull.hpp"
#include "mesh/shapes.hpp"
#include "mesh/topology.hpp"

#include <cmath>

using namespace facetmill;

namespace {

/// Points whose coordinates come from a small generator that Python repeats: x(n+1) = 1103515245 x + 12345
/// modulo 2^31, divided by 2^31.
std::vector<Vec3> cloud(std::size_t count) {
    std::uint64_t x = 1;
    const auto next = [&] {
        x = (1103515245 * x + 12345) % 2147483648U;
        return static_cast<double>(x) / 2147483648.0;
    };
    std::vector<Vec3> points(count);
    for (Vec3& p : points) {
        p.x = next();
        p.y = next();
        p.z = next();
    }
    return points;
}

/// Every point is inside or on every face, exactly.
bool holds(const Mesh& mesh, std::span<const Vec3> points) {
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (const Vec3& p : points)
            if (orientation_3d(mesh.point(3 * f), mesh.point(3 * f + 1), mesh.point(3 * f + 2), p) > 0)
                return false;
    return true;
}

/// Two faces at every edge, in opposite directions.
bool is_closed_manifold(const Mesh& mesh) {
    const EdgeTable edges = build_edges(mesh);
    for (Index e = 0; e < edges.size(); ++e)
        if (edges.corners_of(e).size() != 2) return false;
    return mesh.vertex_count() + mesh.face_count() == edges.size() + 2;
}

HullResult hull_of(std::span<const Vec3> points, HullShape shape = HullShape::hull, std::size_t most = 0) {
    return convex_hull(points, {shape, most});
}

} // namespace

TEST_CASE("hull: volume and vertices of a cloud are equal to Qhull's", "[geometry]") {
    const auto points = cloud(1000);
    const HullResult r = hull_of(points);
    CHECK(r.dimension == HullDimension::space);
    CHECK(r.mesh.vertex_count() == 70);
    CHECK(r.volume == Approx(0.9376648532537124).epsilon(1e-13));
    CHECK(holds(r.mesh, points));
    CHECK(is_closed_manifold(r.mesh));
}

TEST_CASE("hull: the order of the points does not matter", "[geometry]") {
    auto points = cloud(300);
    const HullResult a = hull_of(points);
    std::reverse(points.begin(), points.end());
    points.insert(points.end(), points.begin(), points.begin() + 50);
    const HullResult b = hull_of(points);
    CHECK(a.mesh.positions == b.mesh.positions);
    CHECK(a.mesh.corners == b.mesh.corners);
}

TEST_CASE("hull: a grid of points in a cube has the volume of the cube", "[geometry]") {
    std::vector<Vec3> points;
    for (int i = 0; i < 125; ++i) points.push_back(Vec3{i % 5 + 0.1, (i / 5) % 5 + 0.1, i / 25 + 0.1});
    const HullResult r = hull_of(points);
    CHECK(r.volume == Approx(64));
    CHECK(holds(r.mesh, points));
    CHECK(is_closed_manifold(r.mesh));
}

TEST_CASE("hull: coordinates of any size", "[geometry]") {
    for (const double scale : {1e-150, 1e150}) {
        auto points = cloud(200);
        for (Vec3& p : points) p *= scale;
        for (const HullShape shape :
             {HullShape::hull, HullShape::box, HullShape::sphere, HullShape::capsule}) {
            const HullResult r = hull_of(points, shape, 20);
            CHECK(holds(r.mesh, points));
            CHECK(is_closed_manifold(r.mesh));
        }
    }
}

TEST_CASE("hull: flat points give a front and a back", "[geometry]") {
    std::vector<Vec3> points;
    for (const Vec3& p : cloud(200)) points.push_back({p.x, p.y, p.x}); // the plane z = x
    const HullResult r = hull_of(points);
    CHECK(r.dimension == HullDimension::plane);
    CHECK(r.volume == 0);
    CHECK(r.mesh.face_count() == 2 * (r.mesh.vertex_count() - 2));
    CHECK(is_closed_manifold(r.mesh));
    for (const Vec3& p : r.mesh.positions) CHECK(p.x == p.z);
    const HullResult box = hull_of(points, HullShape::box);
    CHECK(holds(box.mesh, points));
    CHECK(hull_of(points, HullShape::sphere).volume > 0.1);
}

TEST_CASE("hull: points without a hull", "[geometry]") {
    CHECK(hull_of({}).dimension == HullDimension::none);
    CHECK(hull_of(std::vector<Vec3>(5, Vec3{1, 2, 3})).dimension == HullDimension::point);
    const std::vector<Vec3> line{{0, 0, 0}, {1, 2, 3}, {-3, -6, -9}, {0.5, 1, 1.5}};
    CHECK(hull_of(line).dimension == HullDimension::line);
    CHECK(hull_of(line).mesh.positions.empty());
}

TEST_CASE("hull: simpler hulls enclose the points with few vertices", "[geometry]") {
    const Mesh sphere = shapes::icosphere(4);
    const double ball = hull_of(sphere.positions).volume;
    double before = 2;
    for (const std::size_t most : {12U, 32U, 64U, 128U}) {
        const HullResult r = hull_of(sphere.positions, HullShape::hull, most);
        CHECK(r.mesh.vertex_count() <= most);
        CHECK(holds(r.mesh, sphere.positions));
        CHECK(is_closed_manifold(r.mesh));
        CHECK(r.volume / ball < before);
        before = r.volume / ball;
    }
    CHECK(before < 1.06);
}

TEST_CASE("hull: boxes, spheres and capsules", "[geometry]") {
    const double s = std::sqrt(0.5);
    Mesh beam = shapes::cube(); // 4 x 2 x 1, turned about two axes
    for (Vec3& p : beam.positions) {
        p = {4 * p.x, 2 * p.y, p.z};
        p = {s * (p.x - p.y), s * (p.x + p.y), p.z};
        p = {p.x, s * (p.y - p.z), s * (p.y + p.z)};
    }
    const HullResult box = hull_of(beam.positions, HullShape::box);
    CHECK(box.mesh.vertex_count() == 8);
    CHECK(box.volume == Approx(8).epsilon(1e-9));
    CHECK(holds(box.mesh, beam.positions));

    const HullResult ball = hull_of(beam.positions, HullShape::sphere);
    CHECK(std::get<FittedSphere>(ball.fitted).radius == Approx(std::sqrt(21) / 2).epsilon(1e-12));
    CHECK(holds(ball.mesh, beam.positions));

    const HullResult capsule = hull_of(beam.positions, HullShape::capsule);
    const auto& c = std::get<FittedCapsule>(capsule.fitted);
    CHECK(c.radius == Approx(std::sqrt(5) / 2).epsilon(1e-9));
    // The ends follow from the root of a difference, whose rounding of 1e-16 becomes 1e-8.
    CHECK(length(c.ends[1] - c.ends[0]) == Approx(4).epsilon(1e-7));
    CHECK(holds(capsule.mesh, beam.positions));
}
