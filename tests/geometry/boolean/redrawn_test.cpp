// Checks that combine leaves vertices on cut faces only at visible cuts.
#include "support/catch.hpp"
#include "support/clean_laws.hpp"
#include "support/measure.hpp"
#include "support/meshes.hpp"

#include "geometry/boolean/combine.hpp"
#include "mesh/shapes.hpp"
#include "parallel/parallel.hpp"

#include <functional>
#include <numbers>

using namespace facetmill;
using namespace facetmill::test;

namespace {

using Operation = CombineOperation;

Mesh brick(const Vec3& low, const Vec3& high, bool squares = false) {
    Mesh mesh = squares ? shapes::quad_cube() : shapes::cube();
    for (Vec3& p : mesh.positions)
        for (std::size_t k = 0; k < 3; ++k) p[k] = p[k] > 0 ? high[k] : low[k];
    return mesh;
}

/// A prism from z = low to high, whose sides are two triangles each.
Mesh drill_at(const Vec3& middle, double radius, int sides, double low, double high) {
    Mesh mesh;
    const auto n = static_cast<Index>(sides);
    for (const double z : {low, high})
        for (int i = 0; i < sides; ++i) {
            const double turn = 2 * std::numbers::pi * i / sides;
            mesh.positions.push_back(
                {middle.x + radius * std::cos(turn), middle.y + radius * std::sin(turn), z});
        }
    for (Index i = 0; i < n; ++i) {
        const Index j = (i + 1) % n;
        for (const Index v : {i, j, n + j, i, n + j, n + i}) mesh.corners.push_back(v);
        if (i == 0 || j == 0) continue;
        for (const Index v : {Index{0}, j, i, n, n + i, n + j}) mesh.corners.push_back(v);
    }
    return mesh;
}

CombineResult made_of(std::vector<Mesh> meshes, Operation operation) {
    auto r = combine(std::move(meshes), {operation, operation == Operation::unite ? none : Index{1}});
    INFO(r.failure.value_or(CombineFailure{}).why);
    REQUIRE(!r.failure);
    check_solid(r.mesh);
    return r;
}

/// Texture coordinates for each corner, a wedge each.
void put_uv(Mesh& mesh, const std::function<std::array<double, 2>(const Vec3&)>& uv) {
    std::vector<float> numbers;
    for (const Vec3& p : mesh.positions)
        for (const double x : uv(p)) numbers.push_back(static_cast<float>(x));
    mesh.attributes.push_back({"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, AttributeData(numbers)});
}

} // namespace

TEST_CASE("a cut leaves no vertex where it crosses a diagonal", "[geometry][combine]") {
    for (const bool squares : {false, true}) {
        const Mesh a = brick({0, 0, 0}, {1, 1, 1}, squares),
                   b = brick({0.5, 0.25, 0.375}, {1.5, 1.25, 1.375});
        const Mesh united = made_of({a, b}, Operation::unite).mesh;
        CHECK(united.vertex_count() ==
              7 + 7 + 6); // the vertices of each solid outside the other, and the line
        CHECK(test::volume(united) == 2 - 0.5 * 0.75 * 0.625);
        CHECK(made_of({a, b}, Operation::subtract).mesh.vertex_count() == 14);
        CHECK(made_of({a, b}, Operation::intersect).mesh.vertex_count() == 8);
    }
}

TEST_CASE("a drilled plate has the corners of the plate and of the holes", "[geometry][combine]") {
    std::vector<Mesh> meshes{brick({0, 0, 0}, {4, 4, 1})};
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) meshes.push_back(drill_at({i + 0.5, j + 0.5, 0}, 0.3, 16, -1, 2));
    const auto r = made_of(meshes, Operation::subtract);
    CHECK(r.mesh.vertex_count() == 8 + 16 * 2 * 16);
    CHECK(test::euler(r.mesh) == 2 - 2 * 16);
    for (Index f = 0; f < r.mesh.face_count(); ++f) { // the sides of a hole come from its drill
        const bool upright = r.mesh.point(3 * f).z != r.mesh.point(3 * f + 1).z ||
                             r.mesh.point(3 * f).z != r.mesh.point(3 * f + 2).z;
        const Vec3 middle = (r.mesh.point(3 * f) + r.mesh.point(3 * f + 1) + r.mesh.point(3 * f + 2)) / 3;
        const bool outside = std::max(std::abs(middle.x - 2), std::abs(middle.y - 2)) > 1.9;
        CHECK((r.mesh_of_face[f] > 0) == (upright && !outside));
    }
}

TEST_CASE("cuts that a third solid covers leave nothing", "[geometry][combine]") {
    // Two overlapping blocks on a plate: the cut of each in the plate is removed within the other block.
    const Mesh plate = brick({0, 0, 0}, {10, 10, 1}), one = brick({2, 2, 0.5}, {6, 6, 2}),
               other = brick({4, 4, 0.5}, {8, 8, 2});
    const Mesh mesh = made_of({plate, one, other}, Operation::unite).mesh;
    // The plate, the outline of both on it and on top, and the corner of the first on the top of the second.
    CHECK(mesh.vertex_count() == 8 + 8 + 8 + 1);
    CHECK(test::euler(mesh) == 2);
    CHECK(test::volume(mesh) == 100 + 16 + 16 - 4);
}

TEST_CASE("vertices that a solid had stay, and so do faces that differ", "[geometry][combine]") {
    Mesh plate = shapes::cube();
    const Mesh tool = brick({0.2, 0.25, 0.5}, {0.7, 0.75, 2});
    const std::size_t least = 8 + 8;
    CHECK(made_of({plate, tool}, Operation::subtract).mesh.vertex_count() == least);
    std::vector<std::uint32_t> group(
        plate.face_count()); // all differ: where the tool crosses a diagonal shows
    for (Index f = 0; f < group.size(); ++f) group[f] = f;
    plate.attributes.push_back({"group", Domain::face, Role::index, 1, false, AttributeData(group)});
    CHECK(made_of({plate, tool}, Operation::subtract).mesh.vertex_count() == least + 2);
    // A vertex in the middle of a side, away from the cut.
    Mesh finer = shapes::cube();
    const Vec3 middle{0.5, 0.5, 1};
    finer.positions.push_back(middle);
    for (Index f = 0; f < finer.face_count(); ++f) {
        if (finer.point(3 * f).z != 1 || finer.point(3 * f + 1).z != 1 || finer.point(3 * f + 2).z != 1)
            continue;
        for (Index k = 0; k < 3; ++k) { // the diagonal gets it, on both sides
            const Index a = finer.corners[3 * f + k], b = finer.corners[3 * f + (k + 1) % 3],
                        c = finer.corners[3 * f + (k + 2) % 3];
            if ((finer.positions[a] + finer.positions[b]) / 2 != middle) continue;
            finer.corners[3 * f + (k + 1) % 3] = 8;
            for (const Index v : {Index{8}, b, c}) finer.corners.push_back(v);
            break;
        }
        if (f > 11) break;
    }
    REQUIRE(test::closed(finer));
    const Mesh nick = brick({0.75, 0.75, 0.5}, {2, 2, 2});
    CHECK(made_of({finer, nick}, Operation::subtract).mesh.vertex_count() == 9 + 6);
}

TEST_CASE("attributes decide whether two triangles are one flat face", "[geometry][combine]") {
    const Mesh tool = brick({0.2, 0.25, 0.5}, {0.7, 0.75, 2});
    const auto linear = [](const Vec3& p) { return std::array{0.5 * p.x - 0.3 * p.y, p.z + 0.7 * p.y}; };
    Mesh even = shapes::cube(), uneven = shapes::cube();
    put_uv(even, linear);
    put_uv(uneven, [](const Vec3& p) { return std::array{p.x * p.y, p.z}; }); // bent along the diagonal
    const auto r = made_of({even, tool}, Operation::subtract);
    CHECK(r.mesh.vertex_count() == 16);
    const Attribute* uv = r.mesh.find("TEXCOORD_0", Domain::wedge);
    REQUIRE(uv);
    for (Index f = 0; f < r.mesh.face_count(); ++f)
        for (Index c = 3 * f; r.mesh_of_face[f] == 0 && c < 3 * f + 3; ++c)
            for (int k = 0; k < 2; ++k)
                CHECK(uv->value(r.mesh.corners[c], k) ==
                      Approx(linear(r.mesh.point(c))[static_cast<std::size_t>(k)]).margin(1e-6));
    CHECK(made_of({uneven, tool}, Operation::subtract).mesh.vertex_count() == 18);
}

TEST_CASE("what is left of cut faces is the same for any number of threads", "[geometry][combine]") {
    const Mesh a = noisy_icosphere(4, 0.02, 5), b = test::moved(noisy_icosphere(4, 0.02, 6), {0.4, 0.3, 0.2}),
               c = test::moved(noisy_icosphere(4, 0.02, 7), {0.3, -0.3, 0.4});
    set_threads(1);
    const Mesh one = made_of({a, b, c}, Operation::unite).mesh;
    set_threads(3);
    CHECK(test::same_mesh(made_of({a, b, c}, Operation::unite).mesh, one));
    set_threads(0);
}
