// The stages that shape: what they pass on to geometry, and what they report.
#include "geometry/intersect/self_intersections.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/run_stage.hpp"
#include "support/surface.hpp"

#include <cstdio>

using namespace facetmill;
using test::options;
using test::problems_of;
using test::run_stage;
using test::scene_of;

TEST_CASE("relax: a bare number is the iterations", "[stages]") {
    const auto once = run_stage("relax", Value::scalar("2"), scene_of(shapes::icosphere(2)));
    const auto twice =
        run_stage("relax", Value{}, run_stage("relax", Value{}, scene_of(shapes::icosphere(2))).scene);
    CHECK(test::same(once.mesh(), twice.mesh()));
    CHECK(once.record.result["parts"][0]["moved_vertices"] == 162);
    CHECK(once.scene.parts[0].changed);
}

TEST_CASE("relax: attribute changes name every attribute", "[stages]") {
    const auto r = run_stage("relax", Value{}, scene_of(shapes::uv_cube()));
    CHECK(r.record.attribute_changes.size() == 2);
}

TEST_CASE("relax: options out of range are refused with the range", "[stages]") {
    CHECK(problems_of("relax", options({{"lambda", "0"}})).substr(0, 8) == "E-RANGE ");
    CHECK(problems_of("relax", options({{"iterations", "-1"}})).substr(0, 8) == "E-RANGE ");
}

TEST_CASE("crumple: splits, displaces, and resolves its amplitude", "[stages]") {
    const auto r =
        run_stage("crumple", options({{"amplitude", "1%"}, {"seed", "7"}}), scene_of(shapes::quad_cube()));
    CHECK(r.mesh().face_count() == 54);
    CHECK(test::sound(r.mesh(), 2));
    CHECK(r.record.resolved["amplitude"]["is"].get<double>() == Approx(std::sqrt(3.0) / 100));
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

TEST_CASE("crumple: parts that meet stay together", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.parts.push_back(scene.parts.front());
    scene.parts[1].name = "other";
    scene.parts[1].transform.m[0][3] = 1; // its face x = 0 lies on the first one's x = 1
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

TEST_CASE("crumple: avoid keeps faces apart, forbid refuses", "[stages]") {
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
    CHECK(report["kept_apart"] == "faces of the same part");
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
    double far = 0; // from the plane of the face that is named
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

TEST_CASE("crumple: octaves go with a frequency, and refusals speak of crumple", "[stages]") {
    for (const char* name : {"octaves", "roughness"})
        CHECK(problems_of("crumple", options({{name, "1"}})) ==
              std::string("E-CONFLICT crumple: '") + name +
                  "' goes with a frequency above 0 only | for example frequency: 4, or leave it out");
    CHECK(problems_of("crumple", options({{"octaves", "2"}, {"frequency", "3"}})) == "");
    const std::string giant = test::failure([] {
        run_stage("crumple", options({{"grid", "10000"}}), scene_of(shapes::icosphere(2)));
    });
    CHECK(giant.starts_with("limit [E-LIMIT] crumple: part 'part', every face split 10000 x 10000: "));
    CHECK(giant.ends_with("| use a smaller grid, or simplify first"));
    const Value avoid = options({{"grid", "9000"}, {"self_intersections", "avoid"}});
    CHECK(test::failure([&] {
              run_stage("crumple", avoid, scene_of(shapes::icosphere(2)));
          }).starts_with("limit [E-MEMORY] crumple: keeping "));
}

TEST_CASE("a mask that selects nothing is warned of", "[stages]") {
    for (const char* stage : {"crumple", "relax"}) {
        Value o = stage == std::string("crumple") ? options({{"grid", "1"}}) : options({});
        o.set("mask", options({{"material", "nowhere"}}));
        const auto r = run_stage(stage, o, scene_of(shapes::icosphere(1)));
        REQUIRE(r.warnings() == std::vector<std::string>{"W-MASK"});
        CHECK(r.record.warnings[0].message ==
              std::string(stage) + ": the mask selects none of 42 vertices: nothing moves");
        CHECK(r.mesh().positions == shapes::icosphere(1).positions);
    }
}

TEST_CASE("relax: until has many iterations, and says when they were not enough", "[stages]") {
    const auto r = run_stage("relax", options({{"until", "0.01%"}}), scene_of(shapes::icosphere(2)));
    const auto& part = r.record.result["parts"][0];
    CHECK(part["iterations"] > 2);
    CHECK(part["settled"] == true);
    CHECK(part["after"]["volume"].get<double>() > 0.97 * part["before"]["volume"].get<double>());
    CHECK(r.warnings().empty());
    const auto few = run_stage("relax", options({{"until", "0.01%"}, {"iterations", "2"}}),
                               scene_of(shapes::icosphere(2)));
    CHECK(few.record.result["parts"][0]["iterations"] == 2);
    CHECK(few.warnings() == std::vector<std::string>{"W-RELAX-STOPPED"});
    Mesh point = shapes::tetrahedron();
    for (auto& p : point.positions) p = {};
    CHECK(run_stage("relax", options({{"until", "1%"}}), scene_of(point))
              .record.result["parts"][0]["iterations"] == 1);
}

TEST_CASE("relax: a method that shrinks stops before the surface is a point", "[stages]") {
    for (const char* method : {"laplacian", "cotangent", "implicit"}) {
        const auto r = run_stage("relax", options({{"until", "0.001%"}, {"method", method}}),
                                 scene_of(shapes::icosphere(3)));
        const auto& part = r.record.result["parts"][0];
        CAPTURE(method, part["iterations"]);
        CHECK(r.warnings() == std::vector<std::string>{"W-RELAX-STOPPED"});
        CHECK(part["settled"] == false);
        CHECK(part["iterations"] > 1);
        CHECK(part["after"]["area"].get<double>() > 0.6 * part["before"]["area"].get<double>());
    }
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

TEST_CASE("split: smooth methods refuse non-manifold parts by name", "[stages]") {
    CHECK(test::failure([] { run_stage("split", Value::scalar("loop"), scene_of(shapes::fan3())); }) ==
          "stage [E-MANIFOLD] split: loop needs a manifold, oriented mesh; the edge of vertices 0 and 1 has "
          "3 faces (part 'part') | clean repairs non-manifold edges and vertices; midpoint splits them as "
          "they are");
}

TEST_CASE("split: a mesh in a single point has no edges longer than a percentage of it", "[stages]") {
    Mesh point = shapes::tetrahedron();
    for (auto& p : point.positions) p = {};
    CHECK(run_stage("split", options({{"max_edge", "3%"}}), scene_of(point)).mesh().face_count() == 4);
}

TEST_CASE("shaping stages take an empty scene and an empty mesh", "[stages]") {
    for (const char* stage : {"split", "crumple", "relax"}) {
        CHECK(run_stage(stage, Value{}, Scene{}).scene.parts.empty());
        CHECK(run_stage(stage, Value{}, scene_of(Mesh{})).mesh().face_count() == 0);
    }
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

TEST_CASE("split: targets and what they report", "[stages]") {
    const auto r = run_stage("split", options({{"max_edge", "10%"}}), scene_of(shapes::cube()));
    const auto& part = r.record.result["parts"][0];
    CHECK(part["longest_edge"]["after"].get<double>() <= std::sqrt(3.0) / 10);
    CHECK(part["smallest_angle"]["before"].get<double>() == Approx(45));
    CHECK(part["stopped_by"] == "max_edge");
    CHECK(r.warnings().empty());
    const auto few = run_stage("split", options({{"max_faces", "100"}}), scene_of(shapes::cube()));
    CHECK(few.mesh().face_count() <= 100);
    CHECK(few.mesh().face_count() > 92);
    CHECK(few.record.result["parts"][0]["stopped_by"] == "max_faces");
    CHECK(problems_of("split", options({{"method", "core"}, {"max_edge", "1"}})).substr(0, 11) ==
          "E-CONFLICT ");
    CHECK(problems_of("split", options({{"min_angle", "20"}, {"max_faces", "9"}})).substr(0, 11) ==
          "E-CONFLICT ");
    CHECK(problems_of("split", options({{"method", "sqrt3"}, {"feature_angle", "20"}})).substr(0, 11) ==
          "E-CONFLICT ");
    CHECK(problems_of("split", options({{"cut", "widest-angle"}})).substr(0, 11) == "E-CONFLICT ");
}

TEST_CASE("split: a target that is not reached is warned of", "[stages]") {
    const auto r =
        run_stage("split", options({{"max_edge", "10%"}, {"passes", "1"}}), scene_of(shapes::cube()));
    CHECK(r.record.result["parts"][0]["stopped_by"] == "passes");
    REQUIRE(r.warnings() == std::vector<std::string>{"W-SPLIT-STOPPED"});
    CHECK(r.record.warnings[0].message == "part 'part' has edges of 0.7071 left, above max_edge "
                                          "0.1732: passes (1) ended the split");
    const auto full = run_stage("split", options({{"max_faces", "4"}}), scene_of(shapes::cube()));
    CHECK(full.mesh().face_count() == 12);
    REQUIRE(full.warnings() == std::vector<std::string>{"W-SPLIT-NOTHING"});
    CHECK(full.record.warnings[0].message ==
          "part 'part' has 12 faces, and its share of max_faces is 4: nothing is split");
    CHECK(run_stage("split", options({{"max_edge", "9"}}), scene_of(shapes::cube())).warnings().empty());
    for (const char* target : {"max_edge", "min_angle", "max_faces"})
        CHECK(problems_of("split", options({{"cut", "widest-angle"}, {"method", "bisect"}, {target, "9"}})) ==
              std::string("E-CONFLICT split: 'cut: widest-angle' does not go with the target '") + target +
                  "', which its cuts may never reach | leave out cut, or give passes and no target");
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

TEST_CASE("split: narrow faces that are left, and faces that a method leaves, are warned of", "[stages]") {
    Mesh needle;
    needle.positions = {{0, 0, 0}, {9, 0, 0}, {9, 1, 0}};
    needle.corners = {0, 1, 2};
    const auto r = run_stage("split", options({{"min_angle", "20"}, {"passes", "10"}}), scene_of(needle));
    REQUIRE(r.warnings() == std::vector<std::string>{"W-SPLIT-STOPPED"});
    CHECK(r.record.result["parts"][0]["stopped_by"] == "narrow");
    CHECK(r.mesh().face_count() < 5);
    for (const char* method : {"fan", "halve", "diagonal"}) {
        const auto still = run_stage("split", options({{"method", method}}), scene_of(needle));
        CHECK(still.warnings() == std::vector<std::string>{"W-SPLIT-NOTHING"});
        CHECK(still.mesh().face_count() == 1);
    }
}

TEST_CASE("split: pieces over each other and edges of more than two faces are warned of", "[stages]") {
    Mesh dart;
    dart.positions = {{0.5, 0, 0}, {2, 1, 0}, {0, 0, 0}, {2, -1, 0}};
    const Index face[] = {0, 1, 2, 3};
    add_face(dart, face);
    CHECK(run_stage("split", options({{"grid", "3"}}), scene_of(dart)).warnings() ==
          std::vector<std::string>{"W-SPLIT-FOLDED"});
    CHECK(run_stage("split", Value::scalar("quads"), scene_of(dart)).warnings().empty());
    Mesh pillow;
    pillow.positions = {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}};
    pillow.corners = {0, 1, 2, 2, 1, 0};
    CHECK(run_stage("split", Value{}, scene_of(pillow)).warnings() ==
          std::vector<std::string>{"W-SPLIT-SHARED"});
}

TEST_CASE("relax: area and volume before and after; options that go with methods", "[stages]") {
    const auto r = run_stage("relax", options({{"method", "hc"}}), scene_of(shapes::icosphere(2)));
    const auto& part = r.record.result["parts"][0];
    CHECK(part["before"]["volume"].get<double>() > part["after"]["volume"].get<double>());
    CHECK(run_stage("relax", Value{}, scene_of(shapes::grid(2, 2)))
              .record.result["parts"][0]["after"]["volume"]
              .is_null());
    CHECK(problems_of("relax", options({{"method", "taubin"}, {"lambda", "0.9"}})).substr(0, 8) ==
          "E-RANGE ");
    CHECK(problems_of("relax", options({{"pass_band", "0.2"}})) ==
          "E-CONFLICT relax: 'pass_band' goes with the method taubin only");
}

TEST_CASE("simplify: a bare ratio, and what is reported", "[stages]") {
    const auto r = run_stage("simplify", Value::scalar("25%"), scene_of(shapes::icosphere(3)));
    CHECK(r.mesh().face_count() == 320);
    const Json& part = r.record.result["parts"][0];
    CHECK(part["triangles_before"] == 1280);
    CHECK(part["triangles_after"] == 320);
    CHECK(part["stopped_by"] == "ratio");
    CHECK(r.warnings().empty());
}

TEST_CASE("simplify: a target at or above the input is said, and is no failure", "[stages]") {
    const auto r = run_stage("simplify", options({{"faces", "5000"}}), scene_of(shapes::cube()));
    CHECK(r.warnings() == std::vector<std::string>{"W-SIMPLIFY-NOTHING"});
    CHECK(r.record.warnings[0].message ==
          "part 'part' has 12 triangles and 8 vertices, at or below the target: nothing to do");
    CHECK(test::same(r.mesh(), shapes::cube()));
}

TEST_CASE("simplify: what topology does not allow is said, and is no failure", "[stages]") {
    const auto r = run_stage("simplify", options({{"faces", "2"}}), scene_of(shapes::tetrahedron()));
    CHECK(r.warnings() == std::vector<std::string>{"W-SIMPLIFY-STOPPED"});
    CHECK(r.record.warnings[0].message ==
          "part 'part' stopped at 4 triangles, above the target: of the edges left, 6 by topology");
    CHECK(r.record.result["parts"][0]["stopped_by"] == "stuck");
}

TEST_CASE("simplify: a count is shared among the parts", "[stages]") {
    Scene scene = scene_of(shapes::icosphere(3));
    scene.parts.push_back(scene_of(shapes::icosphere(2)).parts.front());
    const auto r = run_stage("simplify", options({{"faces", "400"}}), scene);
    CHECK(r.scene.parts[0].mesh.face_count() == 320);
    CHECK(r.scene.parts[1].mesh.face_count() == 80);
}

TEST_CASE("simplify: needs a target, and a bare 1 or 5000 is no ratio", "[stages]") {
    CHECK(problems_of("simplify", {}) != "");
    CHECK(problems_of("simplify", Value::scalar("1")) != "");
    CHECK(problems_of("simplify", Value::scalar("5000")) != "");
}
