#include "support/catch.hpp"
#include "support/run_stage.hpp"

#include "mesh/shapes.hpp"

using namespace facetmill;
using test::run_stage;
using test::scene_of;

TEST_CASE("orient warns of what it could not do", "[stages]") {
    const auto run = run_stage("orient", "", scene_of(shapes::moebius(9)));
    REQUIRE(run.record.warnings.size() == 1);
    CHECK(run.record.warnings[0].id == "W-ORIENT");
    CHECK(run.record.result["parts"][0]["non_orientable_components"] == 1);
    CHECK(run_stage("orient", "", scene_of(shapes::grid(2, 2))).record.warnings.at(0).id == "W-ORIENT-OPEN");
    CHECK(run_stage("orient", "flip", scene_of(shapes::cube())).record.result["parts"][0]["flipped_faces"] ==
          12);
}
