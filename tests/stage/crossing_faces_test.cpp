// A prism over a bow-tie, whose floor and roof cross themselves, in all stages that depend on the area
// covered by faces.
#include "support/catch.hpp"

#include "geometry/deviation/deviation.hpp"
#include "geometry/edit/moved.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/polygon/polygon.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "mesh/invariants.hpp"
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
Mesh bow_tie_prism() {
    Mesh mesh;
    for (const double z : {0.0, 1.0})
        for (const Vec2 p : {Vec2{0, 0}, Vec2{6, 0}, Vec2{2, 4}, Vec2{4, 4}})
            mesh.positions.push_back({p.x, p.y, z});
    add_face(mesh, std::vector<Index>{3, 2, 1, 0});
    add_face(mesh, std::vector<Index>{4, 5, 6, 7});
    for (Index i = 0; i < 4; ++i) add_face(mesh, std::vector<Index>{i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i});
    return mesh;
}

/// The same with a ceiling of five corners, one of which is lifted out of their plane.
Mesh bent_prism() {
    Mesh mesh = bow_tie_prism();
    mesh.positions[6].z += 0.5;
    mesh.positions.push_back({3, 0, 1});
    Mesh bent;
    bent.positions = mesh.positions;
    add_face(bent, std::vector<Index>{3, 2, 1, 0});
    add_face(bent, std::vector<Index>{4, 8, 5, 6, 7});
    add_face(bent, std::vector<Index>{0, 1, 5, 8, 4});
    for (Index i = 1; i < 4; ++i) add_face(bent, std::vector<Index>{i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i});
    return bent;
}

/// Its floor, seen from above.
Mesh bow_tie() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {6, 0, 0}, {2, 4, 0}, {4, 4, 0}};
    add_face(mesh, std::vector<Index>{0, 1, 2, 3});
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

TEST_CASE("stages that cut faces cut what faces that cross themselves cover", "[stages]") {
    double area = 0;
    for (const Part& tile : run_stage("tile", "3", scene_of(bow_tie_prism())).scene.parts)
        area += test::area(tile.mesh);
    CHECK(area == Approx(2 * floor_area + walls_area));
    const auto half = run_stage("crop", "{footprint: [[0, 0], [3, 0], [3, 5], [0, 5]], axis: z}",
                                scene_of(bow_tie_prism()));
    CHECK(test::area(half.mesh()) == Approx(floor_area + walls_area / 2));
    CHECK(test::area(run_stage("split", "centroid", scene_of(bow_tie_prism())).mesh()) ==
          Approx(2 * floor_area + walls_area));
    // Its two triangles have opposite normals, and each gets its own wall.
    CHECK(test::volume(run_stage("thicken", "1", scene_of(bow_tie())).mesh()) == Approx(9 + 1));
    CHECK(run_stage("thicken", "{thickness: 1%, mode: edges}", scene_of(bow_tie()))
              .record.result["parts"][0]["cylinders"] == 4);
}

TEST_CASE("stages that move vertices leave no faces that cross themselves", "[stages]") {
    for (const auto& [stage, options] : {std::pair{"relax", "3"},
                                         {"relax", "{method: implicit}"},
                                         {"clean", "{self_intersections: local}"}}) {
        INFO(stage << ": " << options);
        const auto run = run_stage(stage, options, scene_of(bow_tie_prism()));
        CHECK(inspect(run.mesh()).closed);
        CHECK_FALSE(fill_crossing_faces(run.mesh()).mesh);
        CHECK(count_fans(run.mesh()) == 0);
        const auto ids = run.warnings();
        CHECK(std::count(ids.begin(), ids.end(), "W-FANS") == 0);
    }
    // A grid accepts at most four corners per face: these faces stay, and a warning lists them.
    for (const auto& [stage, options] :
         {std::pair{"crumple", "0.1%"}, {"crumple", "{amplitude: 0.1%, grid: 1}"}, {"split", "{grid: 2}"}}) {
        INFO(stage << ": " << options);
        const auto ids = run_stage(stage, options, scene_of(bow_tie_prism())).warnings();
        CHECK(std::count(ids.begin(), ids.end(), "W-FANS") == 1);
    }
}

TEST_CASE("what is measured is what faces that cross themselves cover", "[stages]") {
    CHECK(inspect(bow_tie()).area == Approx(floor_area));
    CHECK(surface_size(bow_tie()).area == Approx(floor_area));
    const auto probed = run_stage("probe", "[2, 3, 0]", scene_of(bow_tie())); // next to it
    CHECK(probed.record.result["answers"][0]["distance"].get<double>() == Approx(std::sqrt(0.5)));
    const auto rays = run_stage("probe", "{rays: [2, 3, 1, 0, 0, -1]}", scene_of(bow_tie()));
    CHECK(rays.record.result["answers"][0]["hits"].empty());

    Mesh lobes; // the same by its two triangles
    lobes.positions = {{0, 0, 0}, {6, 0, 0}, {3, 3, 0}, {2, 4, 0}, {4, 4, 0}};
    lobes.corners = {0, 1, 2, 2, 4, 3};
    const auto d = deviation(bow_tie(), lobes, {});
    CHECK(d.forward.maximum == 0);
    CHECK(d.backward.maximum == 0);

    const auto curved = run_stage("measure", "{attributes: gaussian_curvature}", scene_of(bow_tie_prism()));
    CHECK(curved.mesh().find("gaussian_curvature", Domain::vertex)->size() == 8);
    CHECK(broken_invariants(curved.mesh()).empty());
}

TEST_CASE("faces that cross themselves in no plane are named", "[stages]") {
    test::TemporaryDirectory directory;
    const auto path = [&](const char* name) { return (directory / name).string(); };
    for (const auto& [stage, options] : std::vector<std::pair<std::string, std::string>>{
             {"simplify", "100%"},
             {"clip", "{plane: z=0.5}"},
             {"crop", "{footprint: [[0, 0], [3, 0], [3, 4], [0, 4]], axis: z}"},
             {"tile", "3"},
             {"split", "centroid"},
             {"relax", "1"},
             {"thicken", "1%"},
             {"triangulate", "triangles"},
             {"measure", "{}"},
             {"probe", "[2, 3, 0]"},
             {"render", "{path: " + path("a.png") + "}"},
             {"write", "{path: " + path("a.stl") + "}"}}) {
        INFO(stage << ": " << options);
        const auto ids = run_stage(stage, options, scene_of(bent_prism())).warnings();
        CHECK(std::count(ids.begin(), ids.end(), "W-FANS") == 1);
    }
    for (const auto& [stage, options] :
         std::vector<std::pair<std::string, std::string>>{{"transform", "{scale: 2}"},
                                                          {"thicken", "{thickness: 1%, mode: edges}"},
                                                          {"write", "{path: " + path("a.ply") + "}"}}) {
        INFO(stage << ": " << options);
        const auto ids = run_stage(stage, options, scene_of(bent_prism())).warnings();
        CHECK(std::count(ids.begin(), ids.end(), "W-FANS") == 0);
    }
}
