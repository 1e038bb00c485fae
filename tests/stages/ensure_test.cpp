#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/run_stage.hpp"

#include "mesh/shapes.hpp"

using namespace facetmill;
using test::failure;
using test::run_stage;
using test::scene_of;

TEST_CASE("ensure checks what it is given", "[stages]") {
    const auto run = run_stage("ensure", "{closed: true, faces: {max: 5}, min_angle: {min: 60deg}}",
                               scene_of(shapes::cube()));
    std::vector<std::string> failed;
    for (const auto& check : run.state->record.checks)
        if (!check.passed) failed.push_back(check.name + " " + check.expected);
    CHECK(failed.at(0) == "faces at most 5");
    CHECK(failed.at(1).starts_with("min_angle at least "));
    CHECK(failure([] { run_stage("ensure", "{}", scene_of({})); }).substr(0, 47) ==
          "usage [E-MISSING] test.yaml:1:1: ensure needs a");
    CHECK(failure([] { run_stage("ensure", "{closd: true}", scene_of({})); }).find("closed") !=
          std::string::npos);
}
