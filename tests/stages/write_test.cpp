#include "support/catch.hpp"

#include "mesh/shapes.hpp"
#include "support/bench.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>

using namespace facetmill;
using namespace facetmill::test;
namespace fs = std::filesystem;

TEST_CASE("write stages a file, reads it back, and passes the scene on as it was", "[stages]") {
    Bench b;
    Part& part = b.scene.parts.emplace_back();
    part.name = "cube";
    part.mesh = shapes::cube();
    part.transform.m[0][3] = 2;
    b.scene.unit = Unit::m;
    b.scene.up = UpAxis::z;
    b.run("write", options({{"path", "out/c.ply"}, {"unit", "mm"}, {"up", "y"}, {"ascii", "true"}}));
    CHECK_FALSE(fs::exists(b.dir / "out/c.ply"));
    b.state.outputs.commit();
    CHECK(fs::exists(b.dir / "out/c.ply"));
    REQUIRE(b.scene.parts.size() == 1);
    CHECK(b.scene.parts[0].name == "cube");
    CHECK(b.scene.parts[0].mesh.vertex_count() == 8);
    CHECK(b.scene.parts[0].transform.m[0][3] == 2);
    CHECK(b.scene.unit == Unit::m);
    REQUIRE(b.state.record.outputs.size() == 1);
    CHECK(b.state.record.outputs[0].read_back.dump() ==
          R"({"vertices":8,"faces":12,"position_error":0.0,"closed":true,"edge_manifold":true,)"
          R"("vertex_manifold":true,"oriented":true,"degenerate_faces":0,"duplicate_faces":0})");
    CHECK(b.record.warnings.empty());

    Bench again;
    again.state.places = b.state.places;
    again.run("load", Value::scalar("out/c.ply"));
    CHECK(again.scene.bounds().min == Vec3{2000, 0, -1000});
    CHECK(again.scene.bounds().max == Vec3{3000, 1000, 0});
}

TEST_CASE("write takes as many Draco bits as keep vertices distinct", "[stages]") {
    Bench b;
    b.scene.unit = Unit::m;
    b.scene.up = UpAxis::y;
    b.scene.parts.emplace_back().mesh = shapes::icosphere(2);
    Mesh crumb = shapes::icosphere(2); // finer than a step of 14 bits
    for (Vec3& p : crumb.positions) p = p * 1e-4 + Vec3{0.9, 0.9, 0.9};
    append(b.scene.parts[0].mesh, crumb);
    for (const char* path : {"a.glb", "a.drc"}) {
        b.run("write", options({{"path", path}, {"draco", "true"}}));
        CHECK(b.record.warnings.empty());
        CHECK(b.record.result["draco"]["position_bits"].get<int>() > 14);
        CHECK(b.state.record.outputs.back().read_back.dump().find(R"("closed":true,"edge_manifold":true)") !=
              std::string::npos);
    }
    std::vector<Value::Entry> given{{"path", {}, Value::scalar("b.glb")},
                                    {"draco", {}, options({{"position_bits", "14"}})}};
    b.run("write", Value::map(std::move(given)));
    REQUIRE(b.record.warnings.size() == 1);
    CHECK(b.record.warnings[0].id == "W-ROUNDED");
    CHECK(b.record.result["draco"]["why"] == "as given");

    b.scene.parts[0].mesh = shapes::icosphere(2); // 14 are enough for most
    b.run("write", options({{"path", "c.glb"}, {"draco", "true"}}));
    CHECK(b.record.result["draco"]["position_bits"] == 14);
}

TEST_CASE("small meshes have fewer bits, but the steps of the scene", "[stages]") {
    for (const std::string how : {"draco", "quantize"}) {
        for (const std::string grid : {"scene", "mesh"}) {
            Bench b;
            b.scene.unit = Unit::m;
            b.scene.up = UpAxis::y;
            b.scene.parts.emplace_back().mesh = shapes::cube();
            b.scene.parts.emplace_back().mesh = shapes::icosphere(2);
            b.scene.parts[1].transform = {{{0.01, 0, 0, 5}, {0, 0.01, 0, 0}, {0, 0, 0.01, 0}}};
            const double step = length(b.scene.bounds().extent()) / 16383;
            b.run("write",
                  Value::map({{"path", {}, Value::scalar("a.glb")}, {how, {}, options({{"grid", grid}})}}));
            const Json result = b.record.result[how];
            CHECK(result["position_bits"] == (grid == "scene" ? 12 : 14)); // of five, a unit has 12
            CHECK(result.value("least", 14) == (grid == "scene" ? 10 : 14));
            CHECK(b.state.record.outputs.back().read_back["position_error"].get<double>() < step);
        }
    }
}

TEST_CASE("write puts triangles in order, and says what that is worth", "[stages]") {
    const auto written = [](std::vector<std::pair<std::string, std::string>> given) {
        Bench b;
        b.scene.unit = Unit::m;
        b.scene.up = UpAxis::y;
        b.scene.parts.emplace_back().mesh = shapes::icosphere(4);
        b.run("write", options(given));
        return std::pair(b.record.result, b.state.record.outputs.back().bytes);
    };
    const Json drawn = written({{"path", "a.glb"}}).first["order"];
    CHECK(drawn["acmr"].get<double>() < 0.8);
    CHECK(drawn["acmr"].get<double>() < drawn["acmr_before"].get<double>());
    CHECK(drawn["atvr"].get<double>() >= 1);
    CHECK_FALSE(written({{"path", "a.glb"}, {"order", "keep"}}).first.contains("order"));
    const auto bytes = [&](const char* order) {
        return written({{"path", "a.glb"}, {"order", order}, {"meshopt", "true"}}).second;
    };
    CHECK(bytes("size") < bytes("draw"));
    CHECK(bytes("auto") == bytes("size"));
    CHECK(failure([&] {
              written({{"path", "a.ply"}, {"order", "draw"}});
          }).find("'order' works with") != std::string::npos);
    CHECK(failure([&] {
              written({{"path", "a.glb"}, {"order", "keep"}, {"draco", "true"}});
          }).find("'order' and 'draco' exclude each other") != std::string::npos);
}

TEST_CASE("write tells when rounding makes a mesh less sound", "[stages]") {
    Bench b;
    Mesh& mesh = b.scene.parts.emplace_back().mesh;
    mesh = shapes::cube();
    mesh.positions[0].x = 1 - 1e-9; // so near vertex 1 that float32 makes them one
    b.run("write", options({{"path", "full.ply"}, {"precision", "full"}}));
    CHECK(b.record.warnings.empty());
    b.run("write", Value::scalar("c.ply"));
    REQUIRE(b.record.warnings.size() == 1);
    CHECK(b.record.warnings[0].id == "W-ROUNDED");
    CHECK(b.record.warnings[0].message ==
          fmt::format("'{}' has more defects when read back than the scene: 2 degenerate_faces (before: 0)",
                      "c.ply"));
    CHECK(b.record.warnings[0].hint ==
          "32-bit floats moved 1 point onto others: use precision: full to keep all bits");
    CHECK(b.state.record.outputs[1].read_back["closed"] == true);
    b.run("write", Value::scalar("c.stl"));
    REQUIRE(b.record.warnings.size() == 2);
    CHECK(b.record.warnings[1].hint == "the 32-bit floats of stl moved 1 point onto others: put clean: "
                                       "{precision: single, self_intersections: "
                                       "all} before write, or write PLY, OBJ or OFF with precision: full");
    b.run("clean", options({{"precision", "single"}, {"self_intersections", "all"}}));
    b.run("write", Value::scalar("d.stl"));
    CHECK(b.record.warnings.size() == 2); // the hint helps
}

namespace {

/// A hollow ball whose wall is thinner than a step of float32, far from the origin.
Scene thin_ball() {
    Mesh ball = shapes::icosphere(3), inner = shapes::icosphere(3);
    for (Vec3& p : inner.positions) p = p * (1 - 3e-7);
    for (std::size_t c = 0; c < inner.corners.size(); c += 3)
        std::swap(inner.corners[c], inner.corners[c + 1]);
    append(ball, inner);
    for (Vec3& p : ball.positions) p = p * 10.0 + Vec3{100.123, 200.4567, 50.7891};
    return scene_of(std::move(ball), Unit::mm);
}

} // namespace

TEST_CASE("write keeps the purpose of an earlier check in the file", "[stages]") {
    for (const char* path : {"a.stl", "a.3mf", "a.ply", "a.glb"}) {
        Bench b;
        b.scene = thin_ball();
        b.scene.up = UpAxis::y;
        b.run("validate", options({{"for", "printing"}}));
        b.run("write", Value::scalar(path));
        CHECK(b.record.result["fits"] == "printing");
        CHECK(b.scene.parts[0].mesh.face_count() == 2 * 1280); // the scene passes on as it was
        b.run("validate", options({{"for", "printing"}}));
        for (const auto& check : b.state.record.checks) CHECK(check.passed);
        CHECK(b.state.record.checks.back().file == path);
    }
    Bench b; // two solids that overlap become one mesh with intersections
    b.scene = scene_of(shapes::cube(), Unit::mm);
    b.scene.parts.push_back(b.scene.parts[0]);
    b.scene.parts[1].name = "other";
    for (Vec3& p : b.scene.parts[1].mesh.positions) p += Vec3{0.5, 0.25, 0.125};
    b.run("validate", options({{"for", "printing"}}));
    b.run("write", Value::scalar("b.stl"));
    const report::Check& check = b.state.record.checks.back();
    CHECK(check.name == "self_intersections");
    CHECK(check.file == "b.stl");
    CHECK_FALSE(check.passed);
    CHECK(check.hint ==
          "stl joins the parts: put merge and clean: {self_intersections: union} before the check, "
          "or write 3MF");
}

TEST_CASE("write warns if a mesh without an up axis seems to lie on its side in the file", "[stages]") {
    Bench b;
    Mesh tower = shapes::icosphere(1);
    for (Vec3& p : tower.positions) p.z *= 3;
    b.scene = scene_of(std::move(tower), Unit::m);
    b.run("write", Value::scalar("a.glb"));
    REQUIRE(b.record.warnings.size() == 1);
    CHECK(b.record.warnings[0].id == "W-UP");
    b.run("write", Value::scalar("a.3mf")); // z is up in 3MF
    CHECK(b.record.warnings.size() == 1);
    b.scene.up = UpAxis::z;
    b.run("write", Value::scalar("b.glb"));
    CHECK(b.record.warnings.size() == 1);
}

namespace {

/// The ids and hints of warnings when writing to that file.
std::string told_of(Bench& b, const Value& value) {
    b.run("write", value);
    std::string text;
    for (const auto& w : b.record.warnings)
        if (w.id == "W-ROUNDED") text += (text.empty() ? "" : "\n") + w.hint;
    return text;
}

/// Two cubes that touch along an edge without sharing its vertices.
Mesh touching_cubes() {
    Mesh mesh = shapes::cube(), other = shapes::cube();
    for (Vec3& p : other.positions) p += Vec3{1, 1, 0};
    append(mesh, other);
    return mesh;
}

} // namespace

TEST_CASE("write says of seams that come apart that they do", "[stages]") {
    Bench b;
    b.scene.unit = Unit::m;
    b.scene.up = UpAxis::y;
    b.scene.parts.emplace_back().mesh = shapes::uv_cube(); // closed, 24 wedges on 8 vertices
    const std::string ply = told_of(b, Value::scalar("c.ply"));
    CHECK(ply == "ply has one set of attributes per vertex, so seams were cut and 16 vertices were added: "
                 "write OBJ or glTF, or weld after loading (clean)");
    for (const char* path : {"c.obj", "c.glb"}) {
        b.record.warnings.clear();
        CHECK(told_of(b, Value::scalar(path)) == "");
    }
}

TEST_CASE("write says of vertices that the format makes one that it does", "[stages]") {
    Bench b;
    b.scene.unit = Unit::m;
    b.scene.up = UpAxis::y;
    b.scene.parts.emplace_back().mesh = touching_cubes();
    CHECK(told_of(b, Value::scalar("c.stl")) ==
          "stl has no shared vertices, so reading it merges corners at the same position (2 fewer): "
          "write 3MF, PLY, OBJ or OFF, which keep them separate");
    b.record.warnings.clear();
    CHECK(told_of(b, Value::scalar("c.glb")) ==
          "reading glb merges vertices at the same position (2 fewer): use mesh_manifold: true, "
          "or write PLY, OBJ or OFF");
    for (const Value& value : {Value::scalar("c.ply"), Value::scalar("c.obj"), Value::scalar("c.off"),
                               options({{"path", "d.glb"}, {"mesh_manifold", "true"}})}) {
        b.record.warnings.clear();
        CHECK(told_of(b, value) == "");
    }
}

TEST_CASE("write names Draco's bits, and 32-bit floats that move points onto lines", "[stages]") {
    Bench b;
    b.scene.unit = Unit::m;
    b.scene.up = UpAxis::y;
    Mesh& mesh = b.scene.parts.emplace_back().mesh;
    mesh = shapes::icosphere(3);
    std::vector<Value::Entry> given{{"path", {}, Value::scalar("b.glb")},
                                    {"draco", {}, options({{"position_bits", "3"}})}};
    const std::string coarse = told_of(b, Value::map(given));
    CHECK(coarse.find("Draco's 3 bits moved ") == 0);
    CHECK(coarse.ends_with(" points onto others: use more draco.position_bits, or no draco"));
    mesh = shapes::grid(1, 1); // a corner so near the diagonal that float32 puts it on the diagonal
    for (Vec3& p : mesh.positions) p += Vec3{1 << 20, 0, 0};
    mesh.positions[1] = {(1 << 20) + 0.5 - 1e-9, 0.5, 0};
    b.record.warnings.clear();
    CHECK(told_of(b, Value::scalar("l.ply")) ==
          "32-bit floats moved points onto lines of others: use precision: full to keep all bits");
}

TEST_CASE("write makes triangles for readers of no other faces, and leaves the scene its own", "[stages]") {
    Bench b;
    b.scene.unit = Unit::m;
    b.scene.up = UpAxis::y;
    Mesh& mesh = b.scene.parts.emplace_back().mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 3, 0}, {0, 2, 0}, {4, 0, 0}};
    mesh.corners = {0, 1, 2, 3, 4, 1, 5, 2};
    mesh.face_offsets = {0, 5, 8};
    b.run("write", Value::scalar("mixed.ply"));
    REQUIRE(b.record.said.size() == 1);
    CHECK(b.record.said[0].find("faces have 3 to 5 corners") == 0);
    CHECK(b.record.warnings.empty());
    CHECK(b.state.record.outputs.back().read_back["faces"] == 2);
    b.record.said.clear();
    b.run("write", options({{"path", "text.ply"}, {"ascii", "true"}})); // which all read
    CHECK(b.record.said.empty());
    for (const char* path : {"a.ply", "a.obj", "a.off", "a.stl"}) {
        INFO(path);
        b.record.said.clear();
        b.run("write", options({{"path", path}, {"triangulate", "true"}}));
        CHECK(b.record.warnings.empty());
        CHECK(b.state.record.outputs.back().read_back["faces"] == 4);
        CHECK(b.record.said ==
              std::vector<std::string>{"1 face with more than three corners written as triangles"});
        CHECK(b.scene.parts[0].mesh.face_count() == 2);
        CHECK_FALSE(b.scene.parts[0].changed);
    }
}

TEST_CASE("write gives the file normals, and leaves the scene its own", "[stages]") {
    Bench b;
    b.scene.unit = Unit::m;
    b.scene.up = UpAxis::y;
    b.scene.parts.emplace_back().mesh = shapes::cube();
    b.scene.parts[0].name = "cube";
    for (const auto& [normals, feature_angle, wedges] :
         {std::tuple{"smooth", "", 8U}, {"smooth", "40deg", 24U}, {"flat", "", 24U}, {"keep", "", 8U}}) {
        const std::string path = std::string(normals) + feature_angle + ".glb";
        Value given = options({{"path", path}, {"normals", normals}});
        if (*feature_angle) given.set("feature_angle", Value::scalar(feature_angle));
        b.run("write", given);
        CHECK(b.record.warnings.empty());
        CHECK(b.state.record.outputs.back().read_back["closed"] == true);
        CHECK(b.scene.parts[0].mesh.attributes.empty());
        CHECK_FALSE(b.scene.parts[0].mesh.has_seams());
        CHECK_FALSE(b.scene.parts[0].changed);
        Bench again;
        b.state.outputs.commit();
        again.state.places = b.state.places;
        again.run("load", Value::scalar(path));
        const Mesh& mesh = again.scene.parts.at(0).mesh;
        CHECK(mesh.wedge_count() == wedges);
        CHECK((mesh.find("NORMAL", Domain::wedge) != nullptr) == (std::string_view(normals) != "keep"));
    }
    CHECK(problems_of("write", options({{"path", "a.glb"}, {"feature_angle", "30"}})) ==
          "E-CONFLICT write: 'feature_angle' needs normals: smooth | add normals: smooth");
    CHECK(problems_of("write", options({{"path", "a.stl"}, {"normals", "smooth"}}))
              .starts_with("E-CONFLICT write: 'normals' works with 3d-tiles, drc, glb, gltf, obj, off, ply, "
                           "usdz, not with stl"));
}

TEST_CASE("write refuses what it cannot mean", "[stages]") {
    Bench b;
    b.scene.parts.emplace_back().mesh = shapes::cube();
    CHECK(failure([&] {
              b.run("write", Value::scalar("c.qqq"));
          }).starts_with("usage [E-FORMAT] the suffix of 'c.qqq' is unknown | give 'format', one of: "));
    CHECK(failure([&] { b.run("write", Value::scalar("c.xyz")); }) ==
          "usage [E-FORMAT] the suffix of 'c.xyz' is unknown | write .ply, which CloudCompare and "
          "others convert");
    CHECK(failure([&] { b.run("write", Value::scalar("c.DXF")); }) ==
          "usage [E-FORMAT] the suffix of 'c.DXF' is unknown | use section: {path: c.DXF} to draw a "
          "plane section");
    CHECK(failure([&] {
              b.run("write", options({{"path", "c.stl"}, {"unit", "mm"}}));
          }) == "stage [E-UNIT] the scene has no unit, so it cannot be written in mm | give the unit when "
                "you load it: load: {path: ..., unit: mm}");
}
