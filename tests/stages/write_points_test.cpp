#include "support/catch.hpp"

#include "io/codec.hpp"
#include "support/bench.hpp"
#include "support/failure.hpp"

namespace write_points_test {

using namespace facetmill;
using namespace facetmill::test;

TEST_CASE("point clouds are written with their colours, and read again", "[stages]") {
    for (const char* name : {"a.ply", "a.glb", "a.gltf", "a.obj", "a.off"}) {
        INFO(name);
        Bench b;
        put(b.dir / "p.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
            "z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n0 0 0 255 0 "
            "0\n1 0 0 0 255 0\n0 2 0 0 0 255\n");
        b.run("load", options({{"path", "p.ply"}, {"unit", "m"}, {"up", "y"}}));
        b.run("write", Value::scalar(name));
        CHECK(b.record.warnings.empty());
        b.state.outputs.commit();
        b.scene = {};
        b.run("load", Value::scalar(name));
        REQUIRE(b.scene.parts.size() == 1);
        const Mesh& mesh = b.scene.parts[0].mesh;
        CHECK(mesh.face_count() == 0);
        CHECK(mesh.positions == std::vector<Vec3>{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 2, 0}});
        const Attribute* colours = mesh.find("COLOR_0", Domain::wedge);
        REQUIRE(colours);
        CHECK(colours->value(1, 1) == 1);
        CHECK(colours->value(1, 0) == 0);
    }
}

TEST_CASE("formats of faces only refuse point clouds, and scenes without anything are refused", "[stages]") {
    const auto refusal = [](const Value& given) {
        Bench b;
        b.scene.unit = Unit::mm;
        b.scene.parts.emplace_back().mesh.positions = {{0, 0, 0}, {1, 0, 0}};
        return failure([&] { b.run("write", given); });
    };
    const std::string hint = " | points go to glb, gltf, obj, off, ply, without compression";
    for (const char* name : {"a.stl", "a.3mf"})
        CHECK(refusal(Value::scalar(name)) ==
              fmt::format(
                  "stage [E-EMPTY] there is nothing to write to '{}': the scene has points and no faces{}",
                  name, hint));
    CHECK(refusal(options({{"path", "a.glb"}, {"draco", "true"}})).ends_with(hint));
    Bench empty;
    CHECK(failure([&] { empty.run("write", Value::scalar("a.ply")); }).find("the scene has no faces") !=
          std::string::npos);
}

} // namespace write_points_test
