#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/off_file.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
using test::options;
using test::run_stage;
using test::scene_of;

TEST_CASE("transfer: colours come from the nearest points, with their distance", "[stages]") {
    const test::TemporaryDirectory folder;
    test::put(folder / "from.ply",
              "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
              "property float z\nproperty float heat\nelement face 1\n"
              "property list uchar int vertex_indices\nend_header\n"
              "0 0 0 0\n4 0 0 4\n0 4 0 0\n3 0 1 2\n");
    Mesh mesh;
    mesh.positions = {{1, 1, 0.5}, {2, 1, 0}, {1, 2, -2}};
    mesh.corners = {0, 1, 2};
    const auto r = run_stage("transfer", options({{"with", (folder / "from.ply").string()}}), scene_of(mesh));
    const Attribute* heat = nullptr;
    for (const Attribute& a : r.mesh().attributes)
        if (a.name == "heat") heat = &a;
    REQUIRE(heat != nullptr);
    CHECK(heat->value(0, 0) == Approx(1));
    CHECK(heat->value(1, 0) == Approx(2));
    const Attribute* distance = r.mesh().find("distance", Domain::vertex);
    REQUIRE(distance != nullptr);
    CHECK(distance->value(0, 0) == Approx(0.5));
    CHECK(distance->value(2, 0) == Approx(2));
    CHECK(r.record.result["parts"][0]["farthest"] == 2);
    const auto none =
        run_stage("transfer", options({{"with", (folder / "from.ply").string()}, {"attributes", "absent"}}),
                  scene_of(mesh));
    CHECK(none.warnings() == std::vector<std::string>{"W-TRANSFER-NONE"});
}
