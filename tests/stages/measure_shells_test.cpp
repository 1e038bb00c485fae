#include "support/catch.hpp"

#include "mesh/shapes.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;

namespace {

/// A cube of this side, its lowest corner at `at`.
Mesh cube_at(double at, double side) {
    Mesh mesh = shapes::cube();
    const Box box = mesh.bounds();
    for (Vec3& p : mesh.positions) p = (p - box.min) * (side / box.extent().x) + Vec3{at, at, at};
    return mesh;
}

std::vector<Diagnostic> warnings_of(std::initializer_list<Mesh> meshes) {
    Mesh all;
    for (const Mesh& mesh : meshes) append(all, mesh);
    return test::run_stage("measure", "{}", test::scene_of(std::move(all))).record.warnings;
}

} // namespace

TEST_CASE("measure warns of shells that count space twice", "[stages]") {
    const auto nested =
        warnings_of({cube_at(-5, 10), cube_at(-4, 8), cube_at(-3, 6), cube_at(-2, 4), cube_at(-1, 2)});
    REQUIRE(nested.size() == 1);
    CHECK(nested[0].id == "W-SHELLS");
    CHECK(nested[0].message.find("1800") != std::string::npos);
    CHECK(nested[0].message.ends_with("the solid has 648"));
    const auto crossing = warnings_of({cube_at(0, 1), cube_at(0.5, 1)});
    REQUIRE(crossing.size() == 1);
    CHECK(crossing[0].message.ends_with("the solid has 1.875"));
    CHECK(crossing[0].hint.find("self_intersections: union") != std::string::npos);
    CHECK(warnings_of({cube_at(0, 1), cube_at(3, 1)}).empty());
    CHECK(warnings_of({cube_at(0, 1), cube_at(1, 1)}).empty()); // they touch at a corner
}
