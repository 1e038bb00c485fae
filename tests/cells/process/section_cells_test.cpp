#include "cells/process/section_cells.hpp"

#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/cells.hpp"
#include "support/failure.hpp"

using namespace facetmill;
using namespace facetmill::cells;

namespace {

void check_sections(const Mesh& mesh, const Plane& plane, const Transform& to_world = {}) {
    SectionSettings settings;
    settings.plane = plane;
    settings.to_world = to_world;
    const test::TemporaryDirectory folder;
    const CellResources means{folder.path(), test::cell_memory};
    const auto partition = test::cells_of(folder, mesh, 300);
    const Extent a = extent_of_cells(*partition, settings.plane, settings.to_world),
                 b = extent_along(settings.plane, mesh, settings.to_world);
    CHECK(a.low == b.low);
    CHECK(a.high == b.high);
    settings.heights = stack_of(b, std::nullopt, 7).heights;
    settings.heights.push_back(2 * b.high); // beyond the mesh
    const Mesh some = faces_at_planes(*partition, settings, means);
    CHECK(some.face_count() < mesh.face_count() / 2); // so not all of it is in memory
    const auto found = section(some, settings), whole = section(mesh, settings);
    REQUIRE(found.size() == whole.size());
    for (std::size_t k = 0; k < whole.size(); ++k) {
        CHECK(found[k].points == whole[k].points);
        CHECK(found[k].area == whole[k].area);
        REQUIRE(found[k].contours.size() == whole[k].contours.size());
        for (std::size_t c = 0; c < whole[k].contours.size(); ++c) {
            CHECK(found[k].contours[c].begin == whole[k].contours[c].begin);
            CHECK(found[k].contours[c].role == whole[k].contours[c].role);
            CHECK(found[k].contours[c].parent == whole[k].contours[c].parent);
        }
    }
}

} // namespace

TEST_CASE("sections of cells are those of the mesh", "[cells]") {
    const Mesh sphere = test::noisy_icosphere(5, 0.01, 3);
    check_sections(sphere, {{0, 0, 1}, {}, 0});
    check_sections(sphere, {{3, -1, 2}, {0.1, 0, 0}, 0.25});
    Transform turned; // and stretched, and far away
    turned.m[0][0] = 0;
    turned.m[0][1] = -3;
    turned.m[1][0] = 2;
    turned.m[1][1] = 0.5;
    turned.m[2][3] = 1e6;
    check_sections(sphere, {{0, 1, 0.25}, {0, 0, 1e6}, 0}, turned);
    check_sections(test::nasty(3), {{0, 1, 0}, {}, 0});
}

TEST_CASE("sections of cells that are more than memory takes are refused", "[cells]") {
    const test::TemporaryDirectory folder;
    const auto partition = test::cells_of(folder, test::noisy_icosphere(5, 0.01, 3), 300);
    const SectionSettings settings;
    CHECK(test::failure_id([&] {
              faces_at_planes(*partition, settings, {folder.path(), 1000});
          }) == "E-MEMORY");
}
