#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/off_file.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
using test::options;
using test::problems_of;
using test::run_stage;
using test::scene_of;

namespace {

Vec3 normal_at(const Mesh& mesh, Index wedge) {
    const Attribute* a = mesh.find("NORMAL", Domain::wedge);
    REQUIRE(a != nullptr);
    return {a->value(wedge, 0), a->value(wedge, 1), a->value(wedge, 2)};
}

} // namespace

TEST_CASE("normals: smooth by default, with sharp edges by feature_angle", "[stages]") {
    const auto smooth = run_stage("normals", Value{}, scene_of(shapes::cube()));
    CHECK(smooth.mesh().wedge_count() == 8);
    CHECK(length(normal_at(smooth.mesh(), 0)) == Approx(1));
    const auto sharp = run_stage("normals", options({{"feature_angle", "30deg"}}), scene_of(shapes::cube()));
    CHECK(sharp.mesh().wedge_count() == 24);
    CHECK(sharp.record.result["parts"][0]["split_corners"] == 16);
    const auto flat = run_stage("normals", "flat", scene_of(shapes::cube()));
    CHECK(flat.mesh().wedge_count() == 24);
}

TEST_CASE("normals: area weights by the areas of the faces", "[stages]") {
    Mesh mesh; // at vertex 0, a face of area 2 in the plane z = 0 and one of area 1 / 2 in x = 0
    mesh.positions = {{0, 0, 0}, {4, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.corners = {0, 1, 2, 0, 2, 3};
    const auto r = run_stage("normals", "area", scene_of(mesh));
    const Vec3 n = normal_at(r.mesh(), 0);
    CHECK(n.z / n.x == Approx(4));
    const auto by_angle = run_stage("normals", "smooth", scene_of(mesh));
    const Vec3 m = normal_at(by_angle.mesh(), 0);
    CHECK(m.z / m.x == Approx(1));
}

TEST_CASE("normals: keep only mends, and none removes", "[stages]") {
    Mesh mesh = shapes::uv_cube();
    mesh.find("NORMAL", Domain::wedge)->set_value(0, 0, 7);
    const auto kept = run_stage("normals", "keep", scene_of(mesh));
    CHECK(kept.record.result["parts"][0]["mended"] == 1);
    CHECK(length(normal_at(kept.mesh(), 0)) == Approx(1));
    CHECK(run_stage("normals", "none", scene_of(mesh)).mesh().find("NORMAL", Domain::wedge) == nullptr);
}

TEST_CASE("normals: tangents need texture coordinates", "[stages]") {
    const auto r = run_stage("normals", options({{"tangents", "0"}, {"feature_angle", "30deg"}}),
                             scene_of(shapes::uv_cube()));
    const Attribute* tangents = r.mesh().find("TANGENT", Domain::wedge);
    REQUIRE(tangents != nullptr);
    CHECK(tangents->size() == r.mesh().wedge_count());
    const auto without = run_stage("normals", options({{"tangents", "1"}}), scene_of(shapes::uv_cube()));
    CHECK(without.warnings() == std::vector<std::string>{"W-NO-TANGENTS"});
}

TEST_CASE("normals: with takes the normals of the nearest points", "[stages]") {
    const test::TemporaryDirectory folder;
    const std::string fine = test::off_file(folder / "fine.off", shapes::icosphere(4));
    const auto r = run_stage("normals", options({{"with", fine}}), scene_of(shapes::icosphere(1)));
    for (Index w = 0; w < r.mesh().wedge_count(); ++w)
        CHECK(dot(normal_at(r.mesh(), w), r.mesh().positions[r.mesh().vertex_of_wedge(w)]) > 0.999);
    CHECK(r.record.result["parts"][0]["farthest"].get<double>() < 1e-6);
}

TEST_CASE("normals: options without effect are refused", "[stages]") {
    CHECK(problems_of("normals", options({{"method", "flat"}, {"feature_angle", "30deg"}})).substr(0, 11) ==
          "E-CONFLICT ");
    CHECK(problems_of("normals", options({{"method", "none"}, {"tangents", "0"}})).substr(0, 11) ==
          "E-CONFLICT ");
}
