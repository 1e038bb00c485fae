#include "cells/process/inspect_cells.hpp"

#include "cells/partition/numbering.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/cells.hpp"
#include "support/meshes.hpp"
#include "support/temporary.hpp"

using namespace facetmill;
using namespace facetmill::cells;

namespace {

/// Checks that all results from cells equal the results in memory.
void check_equal(const Mesh& mesh, std::uint64_t most) {
    const test::TemporaryDirectory folder;
    Part part;
    part.mesh = mesh;
    part.transform.m[0][0] = -2; // mirrors, and is moved
    part.transform.m[1][3] = 5;
    const auto partition = test::cells_of(folder, mesh, most);
    const Properties a = inspect(part),
                     b = inspect_cells(*partition, part.transform, {folder.path(), test::cell_memory});
    for (const Property& property : property_table()) {
        if (!inspects(property) || property.of_scene()) continue;
        INFO(property.name);
        const auto x = property.get(a), y = property.get(b);
        REQUIRE(x.has_value() == y.has_value());
        if (x) CHECK(*y == Approx(*x).epsilon(1e-12));
    }
    CHECK(b.bounds.min == a.bounds.min);
    CHECK(b.bounds.max == a.bounds.max);
}

} // namespace

TEST_CASE("properties of cells are those of the mesh", "[cells]") {
    for (const std::uint64_t most : {30, 200, 3000, 100000}) {
        check_equal(test::noisy_icosphere(4, 0.01, 7), most);
        check_equal(test::noisy_torus(60, 30, 0.001, 3), most);
        check_equal(test::with_noise(shapes::grid(40, 40), 0.2, 5), most);
    }
    for (unsigned seed = 1; seed <= 6; ++seed) check_equal(test::nasty(seed), 20 + 97 * seed);
}

TEST_CASE("components of cells are counted across borders, and where there are many", "[cells]") {
    Mesh many, fan;
    for (Index f = 0; f < 3000; ++f) {
        const double x = f % 60, y = f / 60;
        for (const Vec3& p : {Vec3{x, y, 0}, Vec3{x + 0.5, y, 0}, Vec3{x, y + 0.5, 0}})
            many.positions.push_back(p);
        add_face(many, std::vector<Index>{3 * f, 3 * f + 1, 3 * f + 2});
        if (f == 0) fan.positions.push_back({0, 0, 0});
        fan.positions.push_back({1, double(f), 0});
        fan.positions.push_back({1, double(f), 1});
        add_face(fan, std::vector<Index>{0, 2 * f + 1, 2 * f + 2});
    }
    check_equal(many, 50);
    check_equal(fan, 50);
}

TEST_CASE("vertices of cells are numbered once each", "[cells]") {
    const test::TemporaryDirectory folder;
    const Mesh mesh = test::noisy_icosphere(4, 0.01, 7);
    const auto partition = test::cells_of(folder, mesh, 100);
    Numbering numbering(partition->tree());
    std::vector<Vec3> places(mesh.vertex_count());
    std::vector<bool> met(mesh.vertex_count(), false);
    for (std::uint32_t leaf = 0; leaf < partition->tree().leaves.size(); ++leaf) {
        const Cell cell = partition->cell(leaf);
        const Numbering::Numbers numbers = numbering.next(cell);
        for (const Index v : numbers.fresh) {
            REQUIRE(numbers.of[v] < met.size());
            CHECK_FALSE(met[numbers.of[v]]);
            met[numbers.of[v]] = true;
            places[numbers.of[v]] = cell.mesh.positions[v];
        }
        for (Index v = 0; v < cell.mesh.vertex_count(); ++v)
            CHECK(places[numbers.of[v]] == cell.mesh.positions[v]);
    }
    CHECK(numbering.count() == mesh.vertex_count());
}
