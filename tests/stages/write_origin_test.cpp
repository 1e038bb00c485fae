#include "support/catch.hpp"

#include "base/json.hpp"
#include "io/codec.hpp"
#include "mesh/shapes.hpp"
#include "support/bench.hpp"
#include "support/failure.hpp"

#include <cmath>

namespace write_origin_test {

using namespace facetmill;
using namespace facetmill::test;

/// A sphere of radius 1 at coordinates as of a zone of UTM, in metres.
Scene surveyed() {
    Scene scene;
    scene.unit = Unit::m;
    scene.up = UpAxis::y;
    Part& part = scene.parts.emplace_back();
    part.name = "ball";
    part.mesh = shapes::icosphere(3);
    for (Vec3& p : part.mesh.positions) p += Vec3{500000.123, 4649776.456, 100.1};
    return scene;
}

Scene read_of(Bench& b, const char* name) {
    b.state.outputs.commit();
    io::ReadLog log;
    return io::read_scene(io::Input::open(b.dir / name), {}, log);
}

/// The greatest distance between vertices of the same number.
double distance_between(const Part& a, const Part& b) {
    REQUIRE(a.mesh.vertex_count() == b.mesh.vertex_count());
    double most = 0;
    for (std::size_t v = 0; v < a.mesh.vertex_count(); ++v)
        most = std::max(
            most, length(a.transform.point(a.mesh.positions[v]) - b.transform.point(b.mesh.positions[v])));
    return most;
}

TEST_CASE("far from the origin, the nodes of a file take the offset", "[stages]") {
    const std::pair<const char*, std::vector<std::pair<const char*, const char*>>> files[] = {
        {"a.glb", {{"order", "keep"}}},
        {"b.glb", {{"draco", "{position_bits: 16}"}}},
        {"c.glb", {{"quantize", "{position: 16}"}}},
        {"d.glb", {{"meshopt", "true"}}},
        {"e.3mf", {}}};
    for (const auto& [name, settings] : files) {
        INFO(name);
        Bench b;
        b.scene = surveyed();
        const Scene given = b.scene;
        Problems problems;
        std::string text = fmt::format("{{path: {}, unit: m, up: y", name);
        for (const auto& [key, value] : settings) text += fmt::format(", {}: {}", key, value);
        const auto source = std::make_shared<const SourceText>(SourceText{"test.yaml", text + "}"});
        b.run("write", pipeline::parse_yaml(source, problems));
        for (const auto& w : b.record.warnings) FAIL_CHECK(w.id << " " << w.message);
        CHECK(b.record.result["origin"]["parts"] == 1);
        // The scene itself is unchanged.
        CHECK(b.scene.parts[0].mesh.positions == given.parts[0].mesh.positions);
        CHECK(b.scene.parts[0].transform.identity());
        CHECK(!b.scene.parts[0].changed);
        const Scene back = read_of(b, name);
        CHECK(back.bounds().min.x > 499999);
        const bool steps = b.record.result.contains("quantize"); // the file has grid coordinates
        if (!steps) CHECK(back.parts[0].mesh.bounds().max.y < 3);
        if (settings.empty() || settings[0].first == std::string("order"))
            CHECK(distance_between(back.parts[0], given.parts[0]) < 1e-6);
        const auto& last = b.state.record.outputs.back().read_back;
        CHECK(last["position_error"].get<double>() < 1e-4);
    }
}

TEST_CASE("far from the origin, faces in another order are not taken for moved", "[stages]") {
    for (const char* name : {"a.glb", "a.3mf"}) {
        INFO(name);
        Bench b;
        b.scene = surveyed();
        for (Vec3& p : b.scene.parts[0].mesh.positions) p += Vec3{1e8, 2e8, -3e8};
        b.run("write", Value::scalar(name));
        for (const auto& w : b.record.warnings) FAIL_CHECK(w.id << " " << w.message);
        read_of(b, name);
        CHECK(b.state.record.outputs.back().read_back["position_error"].get<double>() <
              (std::string(name) == "a.3mf" ? 2e-4 : 2e-7)); // millimetres, metres
    }
}

TEST_CASE("origin: keep, a point, and what is near the origin", "[stages]") {
    Bench b;
    b.scene = surveyed();
    b.run("write", options({{"path", "keep.glb"}, {"origin", "keep"}}));
    CHECK(!b.record.result.contains("origin"));
    REQUIRE(!b.record.warnings.empty());
    CHECK(b.record.warnings.back().id == "W-ROUNDED");
    CHECK(b.record.warnings.back().hint ==
          "write glTF with origin: auto, or PLY, OBJ or OFF with precision: full");
    b.record.warnings.clear();
    b.run("write", options({{"path", "point.glb"}, {"origin", "[500000, 4649776, 100]"}}));
    CHECK(b.record.warnings.empty());
    CHECK(b.record.result["origin"].dump() == R"({"offset":[500000.0,4649776.0,100.0],"parts":1})");
    const Scene back = read_of(b, "point.glb");
    CHECK(back.parts[0].transform.point({0, 0, 0}) == Vec3{500000, 4649776, 100});
    CHECK(std::abs(back.parts[0].mesh.bounds().centre().z - 0.1) < 1e-4);
    CHECK(failure([&] {
              b.run("write", options({{"path", "a.ply"}, {"origin", "[1, 2, 3]"}}));
          }).starts_with("usage [E-"));
    CHECK(failure([&] {
              b.run("write", options({{"path", "a.glb"}, {"origin", "middle"}}));
          }).find("expected auto, keep, or a point ([0, 0, 1])") != std::string::npos);
    Bench near;
    near.scene.parts.emplace_back().mesh = shapes::cube();
    near.scene.unit = Unit::m;
    near.scene.up = UpAxis::y;
    near.run("write", Value::scalar("a.glb"));
    CHECK(!near.record.result.contains("origin"));
    CHECK(read_of(near, "a.glb").parts[0].transform.identity());
}

TEST_CASE("neighbours and instances keep what they share when the origin moves", "[stages]") {
    Bench b;
    b.scene = surveyed();
    b.scene.parts.push_back(b.scene.parts[0]);
    b.scene.parts[1].transform.m[0][3] = 2;
    Part wall = b.scene.parts[0]; // another mesh, with vertices in common
    wall.name = "wall";
    wall.mesh.corners.resize(30);
    b.scene.parts.push_back(wall);
    b.run("write", Value::scalar("a.glb"));
    const Scene back = read_of(b, "a.glb");
    REQUIRE(back.parts.size() == 3);
    CHECK(back.parts[0].mesh.positions == back.parts[1].mesh.positions);
    CHECK(back.parts[1].transform.m[0][3] - back.parts[0].transform.m[0][3] == 2);
    CHECK(back.parts[0].transform == back.parts[2].transform);
    // Equal positions are equal numbers, so no gap appears.
    for (const Vec3& p : back.parts[2].mesh.positions) {
        const auto& all = back.parts[0].mesh.positions;
        CHECK(std::find(all.begin(), all.end(), p) != all.end());
    }
}

} // namespace write_origin_test
