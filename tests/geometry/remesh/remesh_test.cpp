#include "geometry/remesh/remesh.hpp"

#include "geometry/deviation/deviation.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "mesh/face.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/surface.hpp"

#include <limits>

using namespace facetmill;

namespace {

RemeshSettings to_length(double length) {
    RemeshSettings s;
    s.length = length;
    return s;
}

/// The smallest angle of all faces, in degrees, by the law of cosines.
double smallest_angle(const Mesh& mesh) {
    double least = 180;
    for (Index c = 0; c < mesh.corner_count(); ++c) {
        const Index f = c / 3;
        const Vec3 a = mesh.point(c), b = mesh.point(3 * f + (c + 1) % 3),
                   d = mesh.point(3 * f + (c + 2) % 3);
        least = std::min(least, std::acos(dot(normalised(b - a), normalised(d - a))) * 180 / 3.14159265);
    }
    return least;
}

} // namespace

TEST_CASE("remesh: a sphere gets even triangles, finer and coarser", "[remesh]") {
    const Mesh sphere = shapes::icosphere(4); // edges of about 0.07
    for (const double length : {0.04, 0.15, 0.4}) {
        CAPTURE(length);
        const RemeshResult r = remesh(sphere, to_length(length));
        CHECK(test::sound(r.mesh, 2));
        CHECK(smallest_angle(r.mesh) > 28);
        CHECK(r.mean > 0.75 * length);
        CHECK(r.mean < 1.2 * length);
        CHECK(r.longest < 1.6 * length);
        // Every vertex is on the input.
        const FaceTree tree(surface_of(sphere), FaceTree::Use::near);
        Surface points;
        points.positions = r.mesh.positions;
        for (Index v = 0; v < points.positions.size(); ++v)
            points.corners.insert(points.corners.end(), {v, v, v});
        CHECK(deviation_to(points, tree).maximum < 1e-12);
    }
}

TEST_CASE("remesh: edges of a cube stay sharp, and its volume exact", "[remesh]") {
    const RemeshResult r = remesh(shapes::cube(), to_length(0.1));
    CHECK(test::sound(r.mesh, 2));
    CHECK(deviation(surface_of(shapes::cube()), surface_of(r.mesh), {.means = false}).maximum() < 1e-12);
    CHECK(smallest_angle(r.mesh) > 25);
    CHECK(r.feature_edges == 96); // each of the 12 edges is halved three times
    const RemeshResult coarse = remesh(r.mesh, to_length(100));
    CHECK(test::sound(coarse.mesh, 2));
    CHECK(coarse.mesh.face_count() < 60);
    CHECK(deviation(surface_of(shapes::cube()), surface_of(coarse.mesh), {.means = false}).maximum() < 1e-12);
}

TEST_CASE("remesh: seams keep their texture coordinates", "[remesh]") {
    const Mesh cube = shapes::uv_cube();
    const RemeshResult r = remesh(cube, to_length(0.2));
    CHECK(test::sound(r.mesh, 2));
    const auto uv_area = [](const Mesh& m) {
        const Attribute* uv = m.find("TEXCOORD_0", Domain::wedge);
        REQUIRE(uv != nullptr);
        double area = 0;
        for (Index f = 0; f < m.face_count(); ++f) {
            const auto w = m.face_wedges(f);
            const auto u = [&](std::size_t k, int c) { return uv->value(w[k], c) - uv->value(w[0], c); };
            area += std::abs(u(1, 0) * u(2, 1) - u(1, 1) * u(2, 0)) / 2;
        }
        return area;
    };
    CHECK(uv_area(r.mesh) == Approx(uv_area(cube)).epsilon(1e-5));
    const Attribute* normals = r.mesh.find("NORMAL", Domain::wedge);
    REQUIRE(normals != nullptr);
    for (std::size_t w = 0; w < normals->size(); ++w) {
        double largest = 0;
        for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(normals->value(w, c)));
        CHECK(largest > 0.9999); // of a face of the cube, none mixed over an edge
    }
}

TEST_CASE("remesh: borders of materials stay", "[remesh]") {
    Mesh grid = shapes::grid(8, 8);
    std::vector<std::uint32_t> material;
    for (Index f = 0; f < grid.face_count(); ++f) material.push_back(corner_mean(grid, f).x < 4 ? 0 : 1);
    grid.primitives = {{0, {}, {}}, {1, {}, {}}};
    grid.attributes = {{"primitive", Domain::face, Role::index, 1, false, material}};
    const RemeshResult r = remesh(grid, to_length(0.5));
    double first = 0, all = 0;
    for (Index f = 0; f < r.mesh.face_count(); ++f) {
        const double area = length(area_vector(r.mesh, f)) / 2;
        all += area;
        if (r.mesh.primitive_of(f) == 0) first += area;
    }
    CHECK(all == Approx(64));
    CHECK(first == Approx(32));
    CHECK(test::count(r.mesh).euler == 1);
}

TEST_CASE("remesh: edges that are not manifold stay", "[remesh]") {
    const RemeshResult r = remesh(shapes::fan3(), to_length(0.2));
    CHECK(r.locked_edges == 1);
    CHECK(r.longest < 0.35);
    CHECK(test::count(r.mesh).crowded > 1);
    const RemeshResult glass = remesh(shapes::hourglass(), to_length(0.3));
    CHECK(test::count(glass.mesh).pinched == 1);
    CHECK(test::count(glass.mesh).open == 0);
}

TEST_CASE("remesh: a tolerance gives short edges only where the surface is curved", "[remesh]") {
    RemeshSettings s;
    s.tolerance = 0.005;
    s.max_length = 0.4;
    const Mesh sphere = shapes::icosphere(5);
    const RemeshResult r = remesh(sphere, s);
    CHECK(test::sound(r.mesh, 2));
    CHECK(r.mesh.face_count() < sphere.face_count() / 10);
    CHECK(deviation(sphere, r.mesh, {.means = false}).maximum() < 0.01);
    const RemeshResult flat = remesh(shapes::cube(), s);
    CHECK(flat.mean > 0.2);
}

TEST_CASE("remesh: the result does not depend on the number of threads", "[remesh]") {
    const Mesh torus = shapes::torus(64, 32);
    set_threads(1);
    const RemeshResult one = remesh(torus, to_length(0.07));
    set_threads(4);
    const RemeshResult four = remesh(torus, to_length(0.07));
    set_threads(0);
    CHECK(test::same(one.mesh, four.mesh));
    CHECK(test::sound(one.mesh, 0));
}

TEST_CASE("remesh: meshes without a usable area", "[remesh]") {
    Mesh line = shapes::tetrahedron();
    for (Vec3& p : line.positions) p = {p.x, 0, 0};
    CHECK(remesh(line, to_length(0.1)).mesh.face_count() == line.face_count());
    CHECK(remesh(Mesh{}, to_length(0.1)).mesh.face_count() == 0);
    Mesh undefined = shapes::icosphere(2);
    undefined.positions[5].x = std::numeric_limits<double>::quiet_NaN();
    CHECK(remesh(undefined, to_length(0.2)).mesh.face_count() > 0);
    CHECK(test::failure_id([] { static_cast<void>(remesh(shapes::cube(), to_length(1e-9))); }) == "E-LIMIT");
    CHECK(test::failure_id([] { static_cast<void>(remesh(shapes::cube(), to_length(0))); }) == "E-RANGE");
}

TEST_CASE("remesh: texture coordinates are continuous across a sharp edge without a seam", "[remesh]") {
    Mesh roof; // two slopes that meet at x = 0, with u = x
    roof.positions = {{-1, 0, -1}, {0, 0, 0}, {1, 0, -1}, {-1, 1, -1}, {0, 1, 0}, {1, 1, -1}};
    roof.corners = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
    std::vector<float> uv;
    for (const Vec3& p : roof.positions) {
        uv.push_back(static_cast<float>(p.x));
        uv.push_back(static_cast<float>(p.y));
    }
    roof.attributes = {{"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, uv}};
    const Mesh even = remesh(roof, to_length(0.1)).mesh;
    const Attribute* found = even.find("TEXCOORD_0", Domain::wedge);
    REQUIRE(found);
    double most = 0;
    for (Index w = 0; w < even.wedge_count(); ++w)
        most = std::max(most, std::abs(found->value(w, 0) - even.positions[even.vertex_of_wedge(w)].x));
    CHECK(even.face_count() > 200);
    CHECK(most < 1e-6);
}

TEST_CASE("remesh: a wall thinner than the edges gets shorter edges", "[remesh]") {
    Mesh shell = shapes::icosphere(3);
    Mesh inner = shell;
    for (Vec3& p : inner.positions) p = p * 0.99;
    for (std::size_t c = 0; c < inner.corners.size(); c += 3)
        std::swap(inner.corners[c], inner.corners[c + 1]);
    append(shell, inner);
    RemeshSettings settings;
    settings.length = 0.4; // an arc of this length is 0.02 from its chord
    const RemeshResult r = remesh(shell, settings);
    CHECK(r.retries > 0);
    CHECK(r.intersections == 0);
    CHECK(find_self_intersections(r.mesh).count == 0);

    append(shell, shapes::cube()); // crosses the shell
    const RemeshResult crossing = remesh(shell, settings);
    CHECK(crossing.retries == 0);
    CHECK(crossing.input_intersects);
}
