#include "support/catch.hpp"

#include "mesh/shapes.hpp"
#include "support/failure.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
using test::refusal_of;
using test::run_stage;
using test::scene_of;

namespace extrude_stage_test {

TEST_CASE("extrude makes a solid and reports its extent", "[stages]") {
    const auto run = run_stage("extrude", "-2", scene_of(shapes::grid(4, 3), Unit::m));
    const Json& part = run.record.result["parts"][0];
    CHECK(part["low"] == -2);
    CHECK(part["high"] == 0);
    CHECK(part["wall_faces"] == 28);
    CHECK(run.scene.bounds().min.z == -2);
    CHECK(run.warnings().empty());
    Scene y_up = scene_of(shapes::grid(4, 3));
    y_up.up = UpAxis::y;
    for (Vec3& p : y_up.parts[0].mesh.positions) p = {p.x, 0, p.y};
    CHECK(run_stage("extrude", "{by: 1.5}", y_up).scene.bounds().max.y == 1.5);
}

TEST_CASE("extrude names what it refuses", "[stages]") {
    Scene slope = scene_of(shapes::grid(4, 3));
    for (Vec3& p : slope.parts[0].mesh.positions) p.z = p.x;
    CHECK(refusal_of("extrude", "2", slope).find("reaches from 0 to 4, so the level 2") != std::string::npos);
    CHECK(refusal_of("extrude", "{}", slope).starts_with("usage [E-EXTRUDE] extrude: the end is missing"));
    CHECK(refusal_of("extrude", "{to: 1, by: 2}", slope).starts_with("usage [E-EXTRUDE]"));
    CHECK(refusal_of("extrude", "-1", scene_of(shapes::cube())).find("is closed already") !=
          std::string::npos);
}

} // namespace extrude_stage_test
