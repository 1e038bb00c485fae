#include "geometry/intersect/self_intersections.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/capped.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/measure.hpp"
#include "support/run_stage.hpp"
#include "support/surface.hpp"

#include <cstdio>

using namespace facetmill;
using test::options;
using test::problems_of;
using test::run_stage;
using test::scene_of;

TEST_CASE("crumple: splits, displaces, and resolves its amplitude", "[stages]") {
    const auto r =
        run_stage("crumple", options({{"amplitude", "1%"}, {"seed", "7"}}), scene_of(shapes::quad_cube()));
    CHECK(r.mesh().face_count() == 54);
    CHECK(test::sound(r.mesh(), 2));
    CHECK(r.record.resolved.at(0).option == "amplitude");
    CHECK(r.record.resolved.at(0).is == Approx(std::sqrt(3.0) / 100));
    const double most = r.record.result["parts"][0]["largest_move"];
    CHECK(most > 0);
    CHECK(most < 3 * std::sqrt(3.0) * std::sqrt(3.0) / 100);
}

TEST_CASE("crumple: triangulate leaves no bent quads", "[stages]") {
    const auto r = run_stage("crumple", options({{"grid", "2"}, {"triangulate", "true"}}),
                             scene_of(shapes::quad_cube()));
    CHECK(r.mesh().all_triangles());
    CHECK(r.mesh().face_count() == 48);
}

TEST_CASE("crumple: attribute changes tell of splitting and of moving", "[stages]") {
    const auto r = run_stage("crumple", Value{}, scene_of(shapes::uv_cube()));
    REQUIRE(r.record.attribute_changes.size() == 2);
    for (const auto& entry : r.record.attribute_changes)
        CHECK(entry.change.kind == (entry.change.attribute == "NORMAL"
                                        ? AttributeChange::Kind::recomputed
                                        : AttributeChange::Kind::interpolated));
}

TEST_CASE("crumple: a surface far from the origin is roughened, and not moved as a whole", "[stages]") {
    const Mesh ball = shapes::icosphere(2);
    const double smooth = test::area(ball);
    for (const char* amplitude : {"amplitude: 1%", "amplitude: 1%, frequency: 20"})
        for (const double far : {0.0, 5e6, -3e8}) {
            INFO(far);
            Mesh moved = ball;
            for (Vec3& p : moved.positions) p += Vec3{far, far, far};
            const auto r = run_stage("crumple", "{" + std::string(amplitude) + ", grid: 1}", scene_of(moved));
            CHECK(test::area(r.mesh()) > smooth * 1.002);
        }
    Mesh tiny = ball;
    for (Vec3& p : tiny.positions) p *= 1e-46; // float32 has nothing that small
    CHECK(test::area(run_stage("crumple", "{grid: 1, amplitude: 1%}", scene_of(tiny)).mesh()) >
          smooth * 1e-92 * 1.002);
}

TEST_CASE("crumple: files that meet stay together, whatever their sizes", "[stages]") {
    const auto sheet = [](double from, double to, double far) {
        Mesh mesh = shapes::grid(4, 4);
        for (Vec3& p : mesh.positions) p = {far + from + (to - from) * p.x / 4, far + p.y / 4, 0};
        return run_stage("crumple", "{grid: 1, amplitude: 0.1}", scene_of(mesh)).mesh();
    };
    for (const double far : {0.0, 20.0, 40.0, 100.0, 1e4, 1e6, 1e8}) {
        INFO(far);
        const Mesh small = sheet(0, 1, far), large = sheet(1, 9, far);
        for (std::size_t row = 0; row <= 4; ++row)
            CHECK(small.positions[5 * row + 4] == large.positions[5 * row]);
    }
}

TEST_CASE("crumple: parts that meet stay together", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.parts.push_back(scene.parts.front());
    scene.parts[1].name = "other";
    scene.parts[1].transform.m[0][3] = 1; // its face x = 0 coincides with the first's x = 1
    const auto r = run_stage("crumple", options({{"grid", "1"}, {"amplitude", "0.05"}}), scene);
    int met = 0;
    const Mesh cube = shapes::cube();
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t j = 0; j < 8; ++j) {
            if (cube.positions[i] != cube.positions[j] + Vec3{1, 0, 0}) continue;
            ++met;
            const Vec3 a = r.scene.parts[0].mesh.positions[i];
            const Vec3 b = r.scene.parts[1].transform.point(r.scene.parts[1].mesh.positions[j]);
            CHECK(length(a - b) < 1e-15);
        }
    CHECK(met == 4);
}

TEST_CASE("crumple: avoid keeps faces disjoint, forbid refuses", "[stages]") {
    const auto with = [](const char* what) {
        return options({{"amplitude", "0.2"}, {"grid", "3"}, {"self_intersections", what}});
    };
    const auto r = run_stage("crumple", with("avoid"), scene_of(shapes::quad_cube()));
    const auto& report = r.record.result["self_intersections"];
    CHECK(report["before"] == 0);
    CHECK(report["found"] > 0);
    CHECK(report["rounds"] > 0);
    CHECK(find_self_intersections(triangulated(r.mesh())).count == 0);
    CHECK(test::sound(r.mesh(), 2));
    CHECK(test::failure([&] {
              run_stage("crumple", with("forbid"), scene_of(shapes::quad_cube()));
          }).starts_with("stage [E-INTERSECTS] crumple: "));
    CHECK(report["scope"] == "faces of the same part");
    CHECK(find_self_intersections(run_stage("crumple", with("allow"), scene_of(shapes::quad_cube())).mesh())
              .count > 0);
}

TEST_CASE("crumple: forbid names faces of the input and a place on them", "[stages]") {
    const Mesh cube = shapes::quad_cube();
    const std::string text = test::failure([&] {
        run_stage("crumple", options({{"amplitude", "0.2"}, {"self_intersections", "forbid"}}),
                  scene_of(cube));
    });
    CAPTURE(text);
    unsigned found = 0, a = 99, b = 99;
    double x = 9, y = 9, z = 9;
    const std::size_t at = text.find("crumple: ");
    const char* both = "crumple: %u pairs of subdivided faces would intersect, first faces %u and %u of part "
                       "'part', near (%lf, %lf, %lf)";
    const char* one = "crumple: %u pairs of subdivided faces would intersect, first in face %u itself of "
                      "part 'part', near (%lf, %lf, %lf)";
    const bool two = std::sscanf(text.c_str() + at, both, &found, &a, &b, &x, &y, &z) == 6;
    CHECK((two || std::sscanf(text.c_str() + at, one, &found, &a, &x, &y, &z) == 5));
    CHECK(a < 6);
    CHECK((!two || b < 6));
    double far = 0; // from the plane of the given face
    for (Index c = cube.face_begin(a); c < cube.face_end(a); ++c)
        far = std::max(far, length(cube.point(c) - Vec3{x, y, z}));
    CHECK(far < std::sqrt(2.0));
}

TEST_CASE("crumple: parts near each other are warned of when faces are kept apart", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.parts.push_back(scene.parts.front());
    scene.parts[1].name = "other";
    const Value o = options({{"grid", "1"}, {"amplitude", "0.01"}, {"self_intersections", "avoid"}});
    scene.parts[1].transform.m[0][3] = 0.5;
    CHECK(run_stage("crumple", o, scene).warnings() == std::vector<std::string>{"W-CRUMPLE-PARTS"});
    scene.parts[1].transform.m[0][3] = 5;
    CHECK(run_stage("crumple", o, scene).warnings().empty());
}

TEST_CASE("crumple: displacements that are lowered in large steps are warned of", "[stages]") {
    const Value o = options({{"grid", "1"}, {"amplitude", "100%"}, {"self_intersections", "avoid"}});
    const auto r = run_stage("crumple", o, scene_of(shapes::grid(30, 30)));
    CHECK(r.warnings() == std::vector<std::string>{"W-CRUMPLE-COARSE"});
    CHECK(r.record.result["self_intersections"]["coarse"] > 0);
    CHECK(find_self_intersections(r.mesh()).count == 0);
}

TEST_CASE("crumple: octaves go with a frequency, and refusals speak of crumple", "[stages]") {
    for (const char* name : {"octaves", "roughness"})
        CHECK(problems_of("crumple", options({{name, "1"}})) ==
              std::string("E-CONFLICT crumple: '") + name +
                  "' needs a frequency above 0 | for example frequency: 4, or remove it");
    CHECK(problems_of("crumple", options({{"octaves", "2"}, {"frequency", "3"}})) == "");
    const std::string giant = test::failure([] {
        run_stage("crumple", options({{"grid", "10000"}}), scene_of(shapes::icosphere(2)));
    });
    CHECK(giant.starts_with("limit [E-LIMIT] crumple: part 'part', every face split 10000 x 10000: "));
    CHECK(giant.ends_with(
        "| use a smaller grid, simplify first, or give --memory: it can work on cells on disk"));
    const Value avoid = options({{"grid", "9000"}, {"self_intersections", "avoid"}});
    CHECK(test::failure([&] {
              run_stage("crumple", avoid, scene_of(shapes::icosphere(2)));
          }).starts_with("limit [E-MEMORY] crumple: avoiding intersections of "));
}

TEST_CASE("crumple: an amplitude beyond the edges is warned of, with a hint", "[stages]") {
    const auto r =
        run_stage("crumple", options({{"amplitude", "2"}, {"grid", "1"}}), scene_of(shapes::quad_cube()));
    REQUIRE(r.warnings() == std::vector<std::string>{"W-AMPLITUDE"});
    CHECK(r.record.warnings[0].message ==
          "crumple: the amplitude 2 is larger than the mean edge 1 of part 'part': faces intersect");
    CHECK(r.record.warnings[0].hint == "use self_intersections: avoid, or an amplitude below about 0.25");
    CHECK(run_stage("crumple", options({{"amplitude", "0.1"}, {"grid", "1"}}), scene_of(shapes::cube()))
              .warnings()
              .empty());
}

TEST_CASE("crumple: a mask by group, and fractal noise", "[stages]") {
    Mesh mesh = shapes::quad_cube();
    mesh.attributes.push_back(
        {"group", Domain::face, Role::index, 1, false, std::vector<std::uint32_t>{0, 1, 0, 0, 0, 0}});
    Value o = options({{"amplitude", "0.01"}, {"grid", "4"}, {"frequency", "3"}, {"octaves", "4"}});
    o.set("mask", options({{"group", "1"}}));
    const auto r = run_stage("crumple", o, scene_of(mesh));
    CHECK(r.record.result["parts"][0]["moved_vertices"] == 9); // inside the one face of the group
}

TEST_CASE("crumple: rounding to float32 far from the origin is warned of", "[stages]") {
    const auto crumpled = [](double shift) {
        Mesh cube = shapes::cube();
        for (Vec3& p : cube.positions) p.x += shift;
        return run_stage("crumple", options({{"amplitude", "0.01"}, {"self_intersections", "avoid"}}),
                         scene_of(cube))
            .warnings();
    };
    CHECK(crumpled(0).empty());
    CHECK(crumpled(5e6) == std::vector<std::string>{"W-CRUMPLE-ROUNDED"});
}

TEST_CASE("a mask that selects nothing is warned of", "[stages]") {
    for (const char* stage : {"crumple", "relax"}) {
        Value o = stage == std::string("crumple") ? options({{"grid", "1"}}) : options({});
        o.set("mask", options({{"material", "nowhere"}}));
        const auto r = run_stage(stage, o, scene_of(shapes::icosphere(1)));
        REQUIRE(r.warnings() == std::vector<std::string>{"W-MASK"});
        CHECK(r.record.warnings[0].message ==
              std::string(stage) + ": the mask selects none of 42 vertices, so nothing moves");
        CHECK(r.mesh().positions == shapes::icosphere(1).positions);
    }
}

TEST_CASE("crumple: caps of cuts stay planar unless they are free", "[stages]") {
    const Scene capped = test::capped_sphere();
    CHECK(test::cap_unevenness(capped.parts[0].mesh) == 0);
    const auto fixed = run_stage("crumple", "{amplitude: 1%}", capped);
    CHECK(test::cap_unevenness(fixed.mesh()) == 0);
    CHECK(fixed.record.result["parts"][0]["held_vertices"] > 10);
    CHECK(fixed.record.result["parts"][0]["moved_vertices"] > 100);
    const auto free = run_stage("crumple", "{amplitude: 1%, caps: free}", capped);
    CHECK(test::cap_unevenness(free.mesh()) > 0.001);
    CHECK(free.record.result["parts"][0]["held_vertices"] == 0);
    const auto only_caps = run_stage("crumple", "{amplitude: 1%, mask: {attribute: cut_id}}", capped);
    CHECK(only_caps.warnings() == std::vector<std::string>{"W-MASK"});
    CHECK(only_caps.record.result["parts"][0]["moved_vertices"] == 0);
}
