#include "cells/process/split_source.hpp"

#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/cells.hpp"

using namespace facetmill;
using namespace facetmill::cells;

namespace {

void check_split(const Mesh& mesh, std::uint64_t most) {
    const test::TemporaryDirectory folder;
    const CellResources means{folder.path(), test::cell_memory};
    auto partition = test::cells_of(folder, mesh, most);
    Mesh whole = mesh;
    for (int pass = 0; pass < 2; ++pass) {
        const SplitResult in_memory = split(whole, {.method = SplitMethod::midpoint});
        CHECK(shared_spots(*partition, means) == in_memory.shared);
        partition = std::make_unique<Partition>(split_source(partition->shared_source()), means, most);
        whole = in_memory.mesh;
        CHECK(partition->faces() == whole.face_count());
        CHECK(partition->vertices() == whole.vertex_count());
        const Mesh all = test::rejoined(*partition);
        CHECK(all.vertex_count() == whole.vertex_count()); // cells still share their common vertices
        CHECK(test::triangles_of(all) == test::triangles_of(whole));
        const FacetShape a = shape_of_cells(*partition, {}), b = facet_shape(whole);
        CHECK(a.longest_edge == b.longest_edge);
        CHECK(a.smallest_angle == b.smallest_angle);
    }
}

void check_grid(const Mesh& mesh, std::uint64_t most, int grid) {
    const test::TemporaryDirectory folder;
    const CellResources means{folder.path(), test::cell_memory};
    const auto coarse = test::cells_of(folder, mesh, most);
    const Partition cells(split_source(coarse->shared_source(), {grid}), means, most);
    const Mesh whole = grid_split(mesh, grid).mesh;
    CHECK(cells.faces() == whole.face_count());
    CHECK(cells.vertices() == whole.vertex_count()); // points inside of equal faces are not one
    const Mesh all = test::rejoined(cells);
    CHECK(all.vertex_count() == whole.vertex_count());
    CHECK(test::triangles_of(all) == test::triangles_of(whole));
}

} // namespace

TEST_CASE("cells cut by a grid are the cells of the mesh that is cut by a grid", "[cells]") {
    for (const int grid : {1, 2, 3, 5})
        for (const std::uint64_t most : {40, 100000}) {
            check_grid(test::noisy_icosphere(2, 0.01, 7), most, grid);
            check_grid(test::with_noise(shapes::grid(7, 6), 0.2, 5), most, grid);
            check_grid(test::nasty(3), 5 * most, grid);
        }
}

TEST_CASE("cells cut in four are the cells of the mesh that is cut in four", "[cells]") {
    for (const std::uint64_t most : {40, 700, 100000}) {
        check_split(test::noisy_icosphere(3, 0.01, 7), most);
        check_split(test::with_noise(shapes::grid(20, 20), 0.2, 5), most);
        check_split(shapes::fan3(), most);
    }
    check_split(test::nasty(3), 300);
    check_split(test::nasty(4), 50);
}
