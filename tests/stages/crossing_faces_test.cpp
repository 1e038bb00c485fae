// A prism over a bow-tie, whose floor and roof cross themselves, through stages that need triangles.
#include "support/catch.hpp"

#include "geometry/inspect/inspect.hpp"
#include "geometry/polygon/polygon.hpp"
#include "support/measure.hpp"
#include "support/run_stage.hpp"
#include "support/temporary.hpp"

using namespace facetmill;
using test::options;
using test::run_stage;
using test::scene_of;

namespace {

constexpr double floor_area = 9 + 1, walls_area = 8 + 8 * M_SQRT2;

/// One unit high; 9 of its floor run one way round, 1 the other. lifted: one corner of the roof is higher.
Mesh bow_tie_prism(double lifted = 0) {
    Mesh mesh;
    for (const double z : {0.0, 1.0})
        for (const Vec2 p : {Vec2{0, 0}, Vec2{6, 0}, Vec2{2, 4}, Vec2{4, 4}})
            mesh.positions.push_back({p.x, p.y, z});
    mesh.positions[6].z += lifted;
    add_face(mesh, std::vector<Index>{3, 2, 1, 0});
    add_face(mesh, std::vector<Index>{4, 5, 6, 7});
    for (Index i = 0; i < 4; ++i) add_face(mesh, std::vector<Index>{i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i});
    return mesh;
}

} // namespace

TEST_CASE("simplify fills faces that cross themselves", "[stages]") {
    const auto r = run_stage("simplify", "100%", scene_of(bow_tie_prism()));
    CHECK(inspect(r.mesh()).closed);
    CHECK(test::area(r.mesh()) == Approx(2 * floor_area + walls_area));
    CHECK(test::volume(r.mesh()) == Approx(9 - 1));
    CHECK(r.warnings().empty());
}

TEST_CASE("clip cuts what faces that cross themselves cover", "[stages]") {
    const auto half =
        run_stage("clip", options({{"plane", "x=3"}, {"triangulate", "true"}}), scene_of(bow_tie_prism()));
    CHECK(test::area(half.mesh()) == Approx(floor_area + walls_area / 2)); // its half, open
    const auto upper =
        run_stage("clip", options({{"plane", "z=0.5"}, {"cap", "true"}, {"triangulate", "true"}}),
                  scene_of(bow_tie_prism()));
    CHECK(inspect(upper.mesh()).closed);
    CHECK(test::area(upper.mesh()) == Approx(2 * floor_area + walls_area / 2));
    CHECK(test::volume(upper.mesh()) == Approx((9 - 1) / 2.0));
}

TEST_CASE("files of triangles have what faces that cross themselves cover", "[stages]") {
    test::TemporaryDirectory directory;
    for (const char* name : {"a.stl", "a.glb", "a.drc"}) {
        INFO(name);
        const auto path = (directory / name).string();
        const auto written = run_stage("write", "{path: " + path + "}", scene_of(bow_tie_prism()));
        written.state->outputs.commit();
        const auto read = run_stage("load", "{path: " + path + "}", Scene{});
        CHECK(test::area(read.mesh()) == Approx(2 * floor_area + walls_area).epsilon(1e-3));
        CHECK(inspect(read.mesh()).closed);
    }
}

TEST_CASE("faces that cross themselves in no plane are named", "[stages]") {
    CHECK(run_stage("simplify", "100%", scene_of(bow_tie_prism(0.5))).warnings() ==
          std::vector<std::string>{"W-FANS"});
    CHECK(run_stage("clip", options({{"plane", "z=0.5"}, {"triangulate", "true"}}),
                    scene_of(bow_tie_prism(0.5)))
              .warnings() == std::vector<std::string>{"W-FANS"});
}
