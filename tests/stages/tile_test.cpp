#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/measure.hpp"
#include "support/run_stage.hpp"
#include "support/temporary.hpp"

#include <fstream>

using namespace facetmill;
using test::refusal_of;
using test::run_stage;
using test::scene_of;

TEST_CASE("tile makes a part of every cell", "[stages]") {
    const auto run = run_stage("tile", "2", scene_of(shapes::grid(4, 3)));
    REQUIRE(run.scene.parts.size() == 4);
    CHECK(run.scene.parts[0].name == "part.x0.y0");
    CHECK(run.scene.parts[3].name == "part.x1.y1");
    CHECK(test::area(run.scene) == Approx(12));
    CHECK(run.record.result["tiles"][1] ==
          Json({{"part", "part.x1.y0"}, {"tile_x", 1}, {"tile_y", 0}, {"faces", 8}}));
    const auto capped = run_stage("tile", "{size: [0.5, 0.25], axes: zx, origin: [0.25, 0], cap: true}",
                                  scene_of(shapes::cube()));
    CHECK(capped.scene.parts.size() == 12);
    double volume = 0;
    for (const Part& part : capped.scene.parts) volume += test::volume(part.mesh);
    CHECK(volume == Approx(1));
    CHECK(capped.scene.materials.size() == 1);
    CHECK(run_stage("tile", "10mm", scene_of(shapes::cube(), Unit::cm)).scene.parts.size() == 1);
}

TEST_CASE("tile refuses what makes no grid", "[stages]") {
    CHECK(refusal_of("tile", "0", scene_of(shapes::grid(4, 3))) ==
          "usage [E-TILE] tile: 'size' must be above 0, found 0 | write, for example, size: 200mm");
    CHECK(refusal_of("tile", "{size: 1, axes: xx}", scene_of(shapes::grid(4, 3))) ==
          "usage [E-TILE] tile: 'axes' accepts each of x, y, z at most once, found 'xx' | for example axes: "
          "xy");
    CHECK(refusal_of("tile", "{size: [1, 2, 3]}", scene_of(shapes::grid(4, 3))) ==
          "usage [E-TILE] tile: 3 sizes for 2 axes | give one size, or one for each axis");
    CHECK(refusal_of("tile", "{size: []}", scene_of(shapes::grid(4, 3))) ==
          "usage [E-TILE] tile: 'size' is an empty list | give one size, or one for each axis");
    CHECK(refusal_of("tile", "{size: 1, origin: [1]}", scene_of(shapes::grid(4, 3))) ==
          "usage [E-TILE] tile: 1 origins for 2 axes | give one for each axis");
    CHECK(refusal_of("tile", "{size: 0.1, origin: [1e15, 0]}", scene_of(shapes::grid(4, 3))) ==
          "limit [E-TILE] a part lies 1e+16 tiles from the grid's origin along one axis, but at most 1e+09 "
          "are possible | choose a nearer origin, or a larger size");
    Mesh point = shapes::cube();
    for (Vec3& p : point.positions) p = {1, 2, 3};
    CHECK(test::failure([&] {
              run_stage("tile", "10%", scene_of(point));
          }).starts_with("stage [E-TILE] the size of the tiles is 0 in this scene"));
    CHECK(test::failure([&] {
              run_stage("section", "{hatch: 1%}", scene_of(point));
          }).starts_with("stage [E-HATCH] the spacing of 'hatch' is 0 in this scene"));
    CHECK(test::failure([&] {
              run_stage("section", "{spacing: 1%}", scene_of(point));
          }).starts_with("stage [E-SECTION] 'spacing' is 0 in this scene, but it must be above zero"));
}

TEST_CASE("tile puts the points of a cloud into the cells", "[stages]") {
    Mesh cloud;
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 5; ++x)
            cloud.positions.push_back({static_cast<double>(x), static_cast<double>(y), 0});
    const auto run = run_stage("tile", "2", scene_of(cloud));
    REQUIRE(run.scene.parts.size() == 9); // 4 is the start of the third tile
    CHECK(run.scene.parts[0].name == "part.x0.y0");
    CHECK(run.scene.parts[0].mesh.vertex_count() == 4);
    CHECK(run.scene.parts[8].name == "part.x2.y2");
    CHECK(run.scene.parts[8].mesh.positions == std::vector<Vec3>{{4, 4, 0}});
    std::size_t points = 0;
    for (const Part& part : run.scene.parts) points += part.mesh.vertex_count();
    CHECK(points == 25);
    CHECK(run.warnings().empty());
}
