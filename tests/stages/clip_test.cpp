#include "base/math/numbers.hpp"
#include "geometry/inspect/inspect.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/measure.hpp"
#include "support/run_stage.hpp"

#include <algorithm>
#include <set>

using namespace facetmill;
using test::run_stage, test::scene_of;

namespace {

Value text(const char* t) { return Value::scalar(t); }
Value numbers(std::initializer_list<const char*> all) {
    std::vector<Value> items;
    for (const char* n : all) items.push_back(Value::scalar(n));
    return Value::list(std::move(items));
}
Value map(std::initializer_list<std::pair<const char*, Value>> entries) {
    Value m = Value::map({});
    for (const auto& [key, value] : entries) m.set(key, value);
    return m;
}

std::string clip_refusal(const Value& given) {
    return test::failure([&] { run_stage("clip", given, scene_of(shapes::cube())); });
}

double volume_after(const Value& given, Scene scene) {
    return test::volume(run_stage("clip", given, std::move(scene)).scene.parts[0].mesh);
}

} // namespace

TEST_CASE("clip reads planes in every form", "[stages]") {
    const Value yes = text("true");
    const auto volume = [&](Value plane) {
        return volume_after(map({{"plane", std::move(plane)}, {"cap", yes}}), scene_of(shapes::cube()));
    };
    CHECK(volume(text("z=0.25")) == Approx(0.75));
    CHECK(volume(text("y=10%")) == Approx(0.9));
    CHECK(volume(text("x=centre")) == Approx(0.5));
    CHECK(volume(numbers({"2", "0", "0", "-0.5"})) == Approx(0.75));
    CHECK(volume(text("2,0,0,-0.5")) == Approx(0.75));
    CHECK(volume(map({{"normal", numbers({"0", "0", "-3"})}, {"through", numbers({"0", "0", "0.25"})}})) ==
          Approx(0.25));
    CHECK(volume(map({{"normal", numbers({"0", "0", "-3"})}, {"through", text("25%")}})) == Approx(0.75));
    CHECK(volume(map({{"normal", numbers({"1", "1", "1"})}, {"through", text("centre")}})) == Approx(0.5));
    CHECK(volume(map({{"coefficients", numbers({"0", "0", "1", "-0.5"})}})) == Approx(0.5));
}

TEST_CASE("clip takes several planes", "[stages]") {
    const Value planes = Value::list({text("x=25%"), text("y=0.5"), numbers({"0", "0", "-1", "0.5"})});
    CHECK(volume_after(map({{"planes", planes}, {"cap", text("true")}}), scene_of(shapes::cube())) ==
          Approx(0.75 * 0.25));
}

TEST_CASE("a length with a unit needs a scene with one", "[stages]") {
    const Value given = map({{"plane", text("z=250mm")}, {"cap", text("true")}});
    Scene scene = scene_of(shapes::cube());
    scene.unit = Unit::m;
    CHECK(volume_after(given, scene) == Approx(0.75));
    CHECK(clip_refusal(given).starts_with("usage [E-UNIT]"));
}

TEST_CASE("planes stand in the world unless space is local", "[stages]") {
    Scene scene = scene_of(shapes::cube());
    scene.parts[0].transform.m[2][3] = 10;
    const auto volume = [&](const char* plane, const char* space) {
        return volume_after(map({{"plane", text(plane)}, {"cap", text("true")}, {"space", text(space)}}),
                            scene);
    };
    CHECK(volume("z=10.25", "world") == Approx(0.75));
    CHECK(volume("z=0.25", "local") == Approx(0.75));
    CHECK(volume("z=25%", "world") == Approx(0.75));
    CHECK(volume("z=25%", "local") == Approx(0.75));
}

TEST_CASE("keep: both makes two parts", "[stages]") {
    Scene two = scene_of(shapes::cube());
    two.parts.push_back(two.parts[0]);
    two.parts[1].name = "other";
    const auto run = run_stage(
        "clip", map({{"plane", text("z=0.25")}, {"cap", text("true")}, {"keep", text("both")}}), two);
    REQUIRE(run.scene.parts.size() == 4);
    const char* names[] = {"part.front", "part.back", "other.front", "other.back"};
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(run.scene.parts[i].name == names[i]);
        CHECK(test::volume(run.scene.parts[i].mesh) == Approx(i % 2 == 0 ? 0.75 : 0.25));
        CHECK(run.scene.parts[i].changed);
    }
}

TEST_CASE("clip keeps the inside of a box, the outside, or both", "[stages]") {
    const auto volume = [&](Value box, const char* keep) {
        return volume_after(map({{"box", std::move(box)}, {"cap", text("true")}, {"keep", text(keep)}}),
                            scene_of(shapes::cube()));
    };
    const Value corners =
        map({{"min", numbers({"0.25", "0.25", "0.25"})}, {"max", numbers({"2", "0.75", "0.75"})}});
    CHECK(volume(corners, "inside") == Approx(0.1875));
    CHECK(volume(corners, "front") == Approx(0.1875));
    CHECK(volume(corners, "outside") == Approx(0.8125));
    CHECK(volume(text("0.25,0.25,0.25,2,0.75,0.75"), "back") == Approx(0.8125));
    const Value square =
        map({{"centre", numbers({"0.5", "0.5", "0.5"})}, {"size", numbers({"0.5", "0.5", "4"})}});
    CHECK(volume(square, "inside") == Approx(0.25));
    Value turned = square;
    turned.set("angle", text("45deg"));
    CHECK(volume(turned, "inside") == Approx(0.25));
    const auto run = run_stage("clip", map({{"box", corners}, {"cap", text("true")}, {"keep", text("both")}}),
                               scene_of(shapes::cube()));
    REQUIRE(run.scene.parts.size() == 2);
    CHECK(run.scene.parts[0].name == "part.inside");
    CHECK(run.scene.parts[1].name == "part.outside");
    CHECK(test::volume(run.scene.parts[1].mesh) == Approx(0.8125));
}

TEST_CASE("clip remembers its planes from stage to stage, until vertices move", "[stages]") {
    const Value plane =
        map({{"normal", numbers({"1", "0.7", "0.3"})}, {"through", numbers({"0.1", "0.2", "0"})}});
    const Value given = map({{"plane", plane}, {"cap", text("true")}});
    Scene once = run_stage("clip", given, scene_of(shapes::icosphere(3))).scene;
    const auto twice = run_stage("clip", given, once);
    CHECK(twice.record.result["cut_faces"] == 0);
    CHECK(twice.record.result["remembered"] > 80);
    const auto relaxed = run_stage("relax", "{caps: free}", once);
    CHECK(run_stage("clip", given, relaxed.scene).record.result["remembered"] == 0);
    const auto held = run_stage("relax", text("1"), once); // the cap stays where it is
    CHECK(run_stage("clip", given, held.scene).record.result["remembered"] ==
          twice.record.result["remembered"]);
}

TEST_CASE("clip snaps unless told not to", "[stages]") {
    Mesh stl = shapes::cube();
    for (Vec3& p : stl.positions) p.z = static_cast<float>(p.z * 0.1);
    const auto snapped = run_stage("clip", text("z=0.1"), scene_of(stl));
    CHECK(snapped.record.result["snapped"] == 4);
    const Value pure = map({{"plane", text("z=0.1")}, {"snap", text("0")}});
    CHECK(run_stage("clip", pure, scene_of(stl)).record.result["cut_faces"] == 8);
}

TEST_CASE("caps are numbered on from what is there, and their material has a name", "[stages]") {
    const Value given = map({{"planes", Value::list({text("z=0.25"), text("x=0.25")})},
                             {"cap", text("true")},
                             {"cap_material", text("steel")}});
    auto once = run_stage("clip", given, scene_of(shapes::cube()));
    CHECK(once.scene.materials.at(0).name == "steel");
    const auto numbers_of = [](const Scene& scene, const char* name) {
        const Mesh& mesh = scene.parts[0].mesh;
        std::set<double> all;
        const Attribute* a = mesh.find(name, Domain::face);
        for (std::size_t f = 0; a && f < mesh.face_count(); ++f) all.insert(a->value(f, 0));
        return all;
    };
    CHECK(numbers_of(once.scene, "cut_id") == std::set<double>{0, 1, 2});
    const auto more = run_stage("clip", map({{"plane", text("y=0.5")}, {"cap", text("true")}}), once.scene);
    CHECK(numbers_of(more.scene, "cut_id") == std::set<double>{0, 1, 2, 3});
    CHECK(numbers_of(more.scene, "group") == std::set<double>{0, 1, 2, 3});
    CHECK(more.scene.materials.size() == 2);
}

TEST_CASE("caps have a material of their own, made once and only when needed", "[stages]") {
    const Value given = map({{"plane", text("z=0.25")}, {"cap", text("true")}});
    auto once = run_stage("clip", given, scene_of(shapes::cube()));
    REQUIRE(once.scene.materials.size() == 1);
    CHECK(once.scene.materials[0].name == "cap");
    CHECK(once.scene.parts[0].mesh.primitives.at(1).material == 0);
    CHECK(once.record.result["cap_faces"] == 6);
    CHECK(once.record.warnings.empty());
    auto twice = run_stage("clip", map({{"plane", text("x=0.25")}, {"cap", text("true")}}), once.scene);
    CHECK(twice.scene.materials.size() == 1);
    CHECK(run_stage("clip", text("z=0.25"), scene_of(shapes::cube())).scene.materials.empty());
}

TEST_CASE("coefficients may be one text, as on the command line", "[stages]") {
    for (const char* plane : {"[1, 0, 0, -0.25]", "1,0,0,-0.25", "[ 2,0,0,-0.5 ]"})
        CHECK(test::area(run_stage("clip", text(plane), scene_of(shapes::cube())).scene.parts[0].mesh) == 4);
}

TEST_CASE("both sides of several planes are what is in front of all, and the rest", "[stages]") {
    const auto run = run_stage("clip",
                               map({{"planes", Value::list({text("x = 0.25"), text(" y =0.5 ")})},
                                    {"keep", text("both")},
                                    {"cap", text("true")}}),
                               scene_of(shapes::cube()));
    REQUIRE(run.scene.parts.size() == 2);
    CHECK(run.scene.parts[0].name == "part.front");
    CHECK(run.scene.parts[1].name == "part.back");
    CHECK(test::volume(run.scene.parts[0].mesh) == Approx(0.375));
    CHECK(test::volume(run.scene.parts[1].mesh) == Approx(0.625));
    for (const Part& part : run.scene.parts) CHECK(inspect(part.mesh).closed);
}

TEST_CASE("clip that keeps nothing speaks of the planes or the box that it was given", "[stages]") {
    const auto told = [](const char* options) {
        const auto run = run_stage("clip", options, scene_of(shapes::cube()));
        REQUIRE(run.record.warnings.size() == 1);
        return run.record.warnings[0].message + " | " + run.record.warnings[0].hint;
    };
    CHECK(told("z=2") == "clip: nothing of part 'part' was kept | check the position and direction of the "
                         "plane (facetmill info prints the bounds), or keep the other side (keep: back)");
    CHECK(told("{plane: z=-2, keep: back}").ends_with(", or keep the other side (keep: front)"));
    CHECK(told("{box: {min: [5, 5, 5], max: [6, 6, 6]}}") ==
          "clip: nothing of part 'part' was kept | check the position and size of the box (facetmill info "
          "prints the bounds), or keep the rest (keep: outside)");
    CHECK(told("{box: {min: [-5, -5, -5], max: [6, 6, 6]}, keep: outside}")
              .ends_with(", or keep the inside (keep: inside)"));
    CHECK(told("{box: {min: [-5, -5, -5], max: [6, 6, 6]}}") ==
          "clip: the box does not cut part 'part', which stays whole | check the position and size of the "
          "box (facetmill info prints the bounds)");
}

TEST_CASE("clip says when everything or nothing stays, and names open contours", "[stages]") {
    const auto warnings = [](const Value& given, Mesh mesh) {
        std::string all;
        for (const auto& w : run_stage("clip", given, scene_of(std::move(mesh))).record.warnings)
            all += w.id + " " + w.message + "\n";
        return all;
    };
    CHECK(warnings(text("z=-1"), shapes::cube()) ==
          "W-CLIP-ALL clip: no plane cuts part 'part', which stays whole\n");
    CHECK(warnings(text("z=2"), shapes::cube()) == "W-CLIP-NOTHING clip: nothing of part 'part' was kept\n");
    CHECK(warnings(map({{"plane", text("x=1.5")}, {"cap", text("true")}}), shapes::grid(3, 1)) ==
          "W-CAP-OPEN clip: a contour of 2 edges of part 'part' is open and was not capped; it ends at (1.5, "
          "0, 0)\n");
}

TEST_CASE("clip refuses what is no plane", "[stages]") {
    CHECK(clip_refusal(map({{"plane", map({{"normal", numbers({"0", "0", "0"})}})}})) ==
          "usage [E-PLANE] the plane's normal is zero, so it has no direction | give a direction: plane: "
          "{normal: [0, 0, 1]}");
    CHECK(clip_refusal(numbers({"0", "0", "0", "1"})) ==
          "usage [E-PLANE] the plane's normal is zero, so it has no direction | give a direction: plane: "
          "{normal: [0, 0, 1]}");
    CHECK(clip_refusal(map({{"plane", map({{"through", text("centre")}})}})) ==
          "usage [E-PLANE] a plane needs a normal or coefficients | give a direction: plane: {normal: [0, 0, "
          "1]}");
    CHECK(clip_refusal(text("w=3")) ==
          "usage [E-TYPE] expected a plane ({normal: [0, 0, 1], through: centre}, z=0.2, x=10%, "
          "[A, B, C, D]), found 'w=3'");
    CHECK(clip_refusal(map({{"planes", Value::list({})}})) ==
          "usage [E-PLANE] 'planes' is empty | for example planes: [z=0, x=centre]");
    CHECK(clip_refusal(map({{"cap", text("true")}})) ==
          "usage [E-MISSING] clip: one of plane, planes, box is needed");
    const char* hint =
        " | for example {min: [0, 0, 0], max: [1, 1, 1]} or {centre: [0, 0, 0], size: [1, 1, 1]}";
    CHECK(clip_refusal(map({{"box", map({{"min", numbers({"0", "0", "0"})}})}})) ==
          std::string("usage [E-BOX] a box needs min and max, or centre and size") + hint);
    CHECK(
        clip_refusal(map({{"box", text("0,0,0,1,0,1")}})) ==
        "usage [E-BOX] the box has no extent along y: 0 | max must be greater than min along all three axes");
    CHECK(clip_refusal(map({{"box", text("1,2")}}))
              .starts_with("usage [E-TYPE] expected a box ({min: [0, 0, 0]"));
}

TEST_CASE("split takes a method or a grid", "[stages]") {
    const auto faces = [](const Value& given) {
        return run_stage("split", given, scene_of(shapes::cube())).scene.face_count();
    };
    CHECK(faces(Value{}) == 48);
    CHECK(faces(text("centroid")) == 36);
    CHECK(faces(map({{"grid", text("3")}})) == 108);
    CHECK(faces(map({{"method", text("midpoint")}, {"passes", text("2")}})) == 192);
    CHECK(test::failure([&] {
              faces(map({{"method", text("bisect")}, {"grid", text("3")}}));
          }) == "usage [E-CONFLICT] split: 'grid' needs the method grid | remove either method or grid");
    CHECK(test::failure([&] { faces(text("grid")); }) ==
          "usage [E-MISSING] split: the method grid needs 'grid', the number of segments per edge | for "
          "example split: {grid: 3}");
}

TEST_CASE("clip says when vertices far from the origin count as on the plane", "[stages]") {
    Mesh far_away = shapes::cube();
    for (Vec3& p : far_away.positions) p = as_float32(p * 10.3 + Vec3{450000, 5400000, 0}); // y: 5400010.5
    const auto warned = [](const Mesh& mesh, const std::string& options) {
        const auto ids = test::run_stage("clip", options, test::scene_of(mesh)).warnings();
        return std::count(ids.begin(), ids.end(), "W-SNAPPED");
    };
    CHECK(warned(far_away, "{plane: y=5400010.3}") ==
          1); // at these coordinates, float32 has steps of half a metre
    CHECK(warned(far_away, "{plane: y=5400010.3, snap: 0}") == 0);
    CHECK(warned(far_away, "{plane: y=5400005.2}") == 0);
    for (Vec3& p : far_away.positions) p.y += 1e-9; // no floats, within four roundings of a double
    CHECK(warned(far_away, "{plane: y=5400010.5}") == 0);
}

TEST_CASE("clip loses no point of a cloud: those on the plane are in front", "[stages]") {
    Mesh cloud;
    cloud.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    const auto left = [&](const char* options) {
        std::vector<std::size_t> points;
        for (const Part& part : run_stage("clip", options, scene_of(cloud)).scene.parts)
            points.push_back(part.mesh.vertex_count());
        return points;
    };
    CHECK(left("x=1") == std::vector<std::size_t>{2});
    CHECK(left("{plane: x=1, keep: back}") == std::vector<std::size_t>{1});
    CHECK(left("{plane: x=1, keep: both}") == std::vector<std::size_t>{2, 1});
    CHECK(left("x=0") == std::vector<std::size_t>{3});
    CHECK(left("x=2") == std::vector<std::size_t>{1});
    const char* corner = "{planes: [x=1, y=-1], keep: ";
    CHECK(left((std::string(corner) + "both}").c_str()) == std::vector<std::size_t>{2, 1});
    const std::string box = "{box: {min: [0.5, -1, -1], max: [1.5, 1, 1]}, keep: ";
    CHECK(left((box + "inside}").c_str()) == std::vector<std::size_t>{1});
    CHECK(left((box + "outside}").c_str()) == std::vector<std::size_t>{2});
    CHECK(left((box + "both}").c_str()) == std::vector<std::size_t>{1, 2});
}
