#include "support/catch.hpp"

#include "geometry/inspect/inspect.hpp"
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

Mesh together(std::initializer_list<Mesh> meshes) {
    Mesh all;
    for (const Mesh& mesh : meshes) append(all, mesh);
    return all;
}

Mesh nested_boxes() {
    return together({cube_at(-5, 10), cube_at(-4, 8), cube_at(-3, 6), cube_at(-2, 4), cube_at(-1, 2)});
}

report::StageRecord measured(Mesh mesh) {
    return test::run_stage("measure", "{density: 2}", test::scene_of(std::move(mesh))).record;
}

std::vector<Diagnostic> warnings_of(Mesh mesh) { return measured(std::move(mesh)).warnings; }

} // namespace

TEST_CASE("measure warns of shells that count space twice", "[stages]") {
    const auto nested = warnings_of(nested_boxes());
    REQUIRE(nested.size() == 1);
    CHECK(nested[0].id == "W-SHELLS");
    CHECK(nested[0].message.find("1800") != std::string::npos);
    CHECK(nested[0].message.ends_with("the solid has 648"));
    const auto crossing = warnings_of(together({cube_at(0, 1), cube_at(0.5, 1)}));
    REQUIRE(crossing.size() == 1);
    CHECK(crossing[0].message.ends_with("the solid has 1.875"));
    CHECK(crossing[0].hint.find("self_intersections: union") != std::string::npos);
    CHECK(warnings_of(together({cube_at(0, 1), cube_at(3, 1)})).empty());
    CHECK(warnings_of(together({cube_at(0, 1), cube_at(1, 1)})).empty()); // they touch at a corner
}

TEST_CASE("the solid of overlapping shells counts space once in all results of measure", "[stages]") {
    const auto record = measured(nested_boxes());
    for (const auto& solid : {record.result["total"]["solid"], record.result["parts"][0]["solid"]}) {
        CHECK(solid["volume"].get<double>() == Approx(648));
        CHECK(solid["mass"].get<double>() == Approx(1296));
        // A cube of side a has a^5 / 6 about its centre; the shells alternate.
        const double moment = 2 * (1e5 - 32768 + 7776 - 1024 + 32) / 6;
        CHECK(solid["inertia"][0][0].get<double>() == Approx(moment));
    }
    const auto crossing = measured(together({cube_at(0, 1), cube_at(0.5, 1)}));
    CHECK(crossing.result["total"]["solid"]["volume"].get<double>() == Approx(1.875));
}

TEST_CASE("solid_volume counts space once, and volume adds up shells", "[stages]") {
    const auto value = [](const char* name, const Mesh& mesh) {
        InspectSettings settings;
        settings.request(*property_named(name));
        return property_named(name)->get(inspect(mesh, settings));
    };
    CHECK(value("volume", nested_boxes()).value() == Approx(1800));
    CHECK(value("solid_volume", nested_boxes()).value() == Approx(648));
    CHECK(value("solid_volume", together({cube_at(0, 1), cube_at(0.5, 1)})).value() == Approx(1.875));
    CHECK(value("solid_volume", together({cube_at(0, 1), cube_at(3, 1)})).value() == Approx(2));
    Mesh open = cube_at(0, 1);
    open.corners.resize(3);
    CHECK(!value("solid_volume", open));
}
