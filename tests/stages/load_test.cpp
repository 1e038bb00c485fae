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

TEST_CASE("load makes tubes of lines, parts of their own with the lines' materials", "[stages]") {
    Bench b;
    put(b.dir / "w.obj", "o frame\nusemtl steel\nv 0 0 0\nv 3 0 0\nv 3 4 0\nl 1 2 3\nusemtl glass\nf 1 2 3\n"
                         "o stick\nv 0 0 9\nv 1 0 9\nv 2 0 9\nusemtl steel\nl 4 5\nusemtl brass\nl 5 6\n");
    b.run("load", options({{"path", "w.obj"}, {"lines", "0.1"}}));
    REQUIRE(b.scene.parts.size() == 3);
    CHECK(b.scene.parts[0].name == "frame");
    CHECK(b.scene.parts[1].name == "frame_lines");
    CHECK(b.scene.parts[2].name == "stick");
    const Mesh &frame = b.scene.parts[1].mesh, &stick = b.scene.parts[2].mesh;
    CHECK(frame.face_count() == 18); // two lines of eight sides, two ends
    REQUIRE(frame.primitives.size() == 1);
    CHECK(b.scene.materials.at(frame.primitives[0].material).name == "steel");
    CHECK(stick.primitives.size() == 2);
    CHECK(b.record.warnings.empty());
    CHECK(b.record.said == std::vector<std::string>{"4 lines became 3 tubes"});
}

TEST_CASE("the thickness of lines may be a share of the file, and must be more than nothing", "[stages]") {
    Bench b;
    put(b.dir / "w.obj", "v 0 0 0\nv 3 0 0\nv 3 4 0\nl 1 2 3\n");
    put(b.dir / "t.stl", triangle_stl);
    b.run("load", options({{"path", "w.obj"}, {"lines", "2%"}, {"line_sides", "4"}}));
    REQUIRE(b.scene.parts.size() == 1);
    CHECK(b.scene.parts[0].name == "w");
    CHECK(b.record.resolved.at(0).option == "lines");
    CHECK(b.record.resolved.at(0).is == Approx(0.1));
    CHECK(b.scene.parts[0].mesh.face_count() == 10);
    b.run("load", options({{"path", "t.stl"}, {"lines", "1"}}));
    REQUIRE(b.record.warnings.size() == 1);
    CHECK(b.record.warnings[0].id == "W-LINES");
    put(b.dir / "p.obj", "v 1 1 1\nv 1 1 1\nl 1 2\n");
    CHECK(failure([&] {
              b.run("load", options({{"path", "p.obj"}, {"lines", "1%"}}));
          }).starts_with("stage [E-LINES]"));
}
