#include "support/catch.hpp"

#include "mesh/shapes.hpp"
#include "support/bench.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>

using namespace facetmill;
using namespace facetmill::test;

namespace {

const char* const triangle_stl = "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 10 0 "
                                 "0\nvertex 0 0 20\nendloop\nendfacet\nendsolid\n";

} // namespace

TEST_CASE("load adds parts with names of their own and records what it read", "[stages]") {
    Bench b;
    put(b.dir / "t.stl", triangle_stl);
    b.run("load", Value::scalar("t.stl"));
    b.run("load", Value::scalar("*.stl"));
    REQUIRE(b.scene.parts.size() == 2);
    CHECK(b.scene.parts[0].name == "t");
    CHECK(b.scene.parts[1].name == "t_2");
    REQUIRE(b.state.record.inputs.size() == 2);
    CHECK(b.state.record.inputs[0].path == (b.dir / "t.stl").string());
    CHECK(b.state.record.inputs[0].bytes == std::string_view(triangle_stl).size());
    CHECK(b.state.record.inputs[0].sha256.size() == 64);
    CHECK(b.state.load_diagonal == std::sqrt(500.0));
    CHECK(failure([&] { b.run("load", Value::scalar("no_*.stl")); }) ==
          "missing [E-FILE] no file matches 'no_*.stl'");
    CHECK(failure([&] {
              b.run("load", options({{"path", "t.stl"}, {"format", "stll"}}));
          }) == "usage [E-FORMAT] there is no format 'stll' | did you mean 'stl'?");
}

TEST_CASE("later files are converted to the unit and axis of the first", "[stages]") {
    Bench b;
    put(b.dir / "t.stl", triangle_stl);
    b.run("load", options({{"path", "t.stl"}, {"unit", "m"}, {"up", "y"}}));
    b.run("load", options({{"path", "t.stl"}, {"unit", "cm"}, {"up", "z"}}));
    CHECK(b.scene.unit == Unit::m);
    const Transform& t = b.scene.parts[1].transform;
    const Vec3 p = t.point({0, 0, 20});
    CHECK(p == Vec3{0, 20 * 0.01, 0});
    b.run("load", Value::scalar("t.stl"));
    REQUIRE(b.record.warnings.size() == 1);
    CHECK(b.record.warnings[0].id == "W-UNITS");
}

TEST_CASE("weld says whether places make vertices", "[stages]") {
    for (const auto& [weld, vertices] :
         {std::pair{"auto", 8U}, std::pair{"exact", 8U}, std::pair{"none", 36U}}) {
        Bench b;
        b.scene.parts.emplace_back().mesh = shapes::cube();
        b.run("write", Value::scalar("c.stl"));
        b.state.outputs.commit();
        b.scene = {};
        b.run("load", options({{"path", "c.stl"}, {"weld", weld}}));
        CHECK(b.scene.parts.at(0).mesh.vertex_count() == vertices);
    }
}

TEST_CASE("a name that ends in .gz is compressed, and read so", "[stages]") {
    Bench b;
    b.scene.parts.emplace_back().mesh = shapes::icosphere(2);
    b.run("write", Value::scalar("s.obj.gz"));
    b.state.outputs.commit();
    b.scene = {};
    b.run("load", Value::scalar("s.obj.gz"));
    CHECK(b.scene.face_count() == 320);
    CHECK(b.scene.parts[0].name == "s");
    CHECK(get(b.dir / "s.obj.gz").starts_with("\x1f\x8b"));
}

TEST_CASE("load warns of sizes that products of coordinates cannot follow", "[stages]") {
    for (const auto& [side, warns] :
         {std::pair{"1e-61", true}, {"1e-50", false}, {"1e50", false}, {"1e61", true}}) {
        Bench bench;
        put(bench.dir / "a.off", fmt::format("OFF\n3 1 0\n0 0 0\n{} 0 0\n0 {} 0\n3 0 1 2\n", side, side));
        bench.run("load", Value::scalar("a.off"));
        CHECK(bench.record.warnings.size() == std::size_t{warns});
        if (warns) CHECK(bench.record.warnings.at(0).id == "W-SIZE");
    }
}
