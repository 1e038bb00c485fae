#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/off_file.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
using test::options;
using test::run_stage;
using test::scene_of;

namespace {

const char* const tetrahedron =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

Mesh same() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    return mesh;
}

} // namespace

TEST_CASE("look: equal scenes have equal pictures, others fail", "[stages][look]") {
    const test::TemporaryDirectory folder;
    test::put(folder / "a.off", tetrahedron);
    const Value use = options({{"with", (folder / "a.off").string()}, {"max", "2%"}, {"pixels", "64"}});
    const auto equal = run_stage("look", use, scene_of(same()));
    CHECK(equal.record.result["difference"] == 0);
    CHECK(equal.record.result["structural_similarity"] == 1);
    REQUIRE(equal.state->record.checks.size() == 1);
    CHECK(equal.state->record.checks[0].passed);
    Mesh other = same();
    other.positions[3].z = 0.2;
    const auto differs = run_stage("look", use, scene_of(other));
    CHECK_FALSE(differs.state->record.checks.at(0).passed);
    CHECK(differs.record.result["structural_similarity"].get<double>() < 0.9);
}

TEST_CASE("look: without a loaded scene it needs a file", "[stages][look]") {
    CHECK(test::failure([] { run_stage("look", "5%", scene_of(same())); }).find("E-LOOK") !=
          std::string::npos);
}
