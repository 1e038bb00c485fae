#include "support/catch.hpp"

#include "io/codec.hpp"
#include "io/not_finite.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/failure.hpp"
#include "support/temporary.hpp"

#include <cstring>
#include <limits>

using namespace facetmill;
using namespace facetmill::test;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

Scene read_dropping(const std::string& name, std::string_view text, io::ReadLog& log) {
    const auto bytes = bytes_of(text);
    io::ReadSettings settings;
    settings.drop_not_finite = true;
    return io::read_scene(io::Input::of(name, {bytes.begin(), bytes.end()}), settings, log);
}

/// Two triangles on four vertices, of which one that only the second uses has `bad` for a coordinate.
std::string text_of(const std::string& suffix, const std::string& bad) {
    if (suffix == "obj") return "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 " + bad + " 0\nf 1 2 3\nf 2 4 3\n";
    if (suffix == "off") return "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 " + bad + " 0\n3 0 1 2\n3 1 3 2\n";
    if (suffix == "ply")
        return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
               "z\n"
               "element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 " +
               bad + " 0\n3 0 1 2\n3 1 3 2\n";
    const auto facet = [](const std::string& corners) {
        return "facet normal 0 0 1\nouter loop\n" + corners + "endloop\nendfacet\n";
    };
    return "solid a\n" + facet("vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n") +
           facet("vertex 1 0 0\nvertex 1 " + bad + " 0\nvertex 0 1 0\n") + "endsolid a\n";
}

} // namespace

TEST_CASE("vertices that are not finite are left out with their faces, on request", "[io]") {
    for (const std::string suffix : {"obj", "off", "ply", "stl"})
        for (const std::string bad : {"nan", "inf", "-inf"}) {
            INFO(suffix << " " << bad);
            io::ReadLog log;
            const Scene scene = read_dropping("a." + suffix, text_of(suffix, bad), log);
            REQUIRE(scene.parts.size() == 1);
            CHECK(scene.parts[0].mesh.face_count() == 1);
            CHECK(scene.parts[0].mesh.vertex_count() == 3);
            CHECK(broken_invariants(scene.parts[0].mesh).empty());
            REQUIRE(log.warnings.size() == 1);
            CHECK(log.warnings[0].id == "W-NOT-FINITE");
            CHECK(log.warnings[0].message ==
                  "1 vertex of part 'a' whose coordinates are not finite numbers is left "
                  "out, with 1 face; the first is vertex 3");
        }
}

TEST_CASE("binary STL with corners that are not finite loses their triangles", "[io]") {
    std::string bytes(80, ' ');
    const auto put = [&](auto value) {
        char raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);
        bytes.append(raw, sizeof value);
    };
    put(std::uint32_t{2});
    for (const float bad : {1.0F, std::numeric_limits<float>::quiet_NaN()}) {
        for (const float x : {0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, bad, 0.F}) put(x);
        put(std::uint16_t{0});
    }
    io::ReadLog log;
    const Scene scene = read_dropping("a.stl", bytes, log);
    CHECK(scene.parts[0].mesh.face_count() == 1);
    CHECK(scene.parts[0].mesh.vertex_count() == 3);
    CHECK(log.warnings.size() == 1);
}

TEST_CASE("a file without any finite vertex is refused as empty", "[io]") {
    CHECK(failure([] {
              io::ReadLog log;
              read_dropping("a.obj", "v nan 0 0\nv 0 nan 0\nv 0 0 inf\nf 1 2 3\n", log);
          }).starts_with("malformed [E-EMPTY]"));
}

TEST_CASE("isolated vertices and lines that are not finite go, all else stays as it is", "[io]") {
    Part part;
    part.mesh = shapes::quad_cube();
    part.mesh.positions.push_back({1, 2, 3});
    part.mesh.positions.push_back({nan_value, 0, 0});
    const Mesh cube = part.mesh;
    const io::NotFinite dropped = io::drop_not_finite(part);
    CHECK(dropped.vertices == 1);
    CHECK(dropped.faces == 0);
    CHECK(dropped.first == 9);
    CHECK(part.mesh.vertex_count() == 9);
    CHECK(part.mesh.corners == cube.corners);
    CHECK(part.changed);

    Part lines;
    lines.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {nan_value, 0, 0}, {2, 0, 0}};
    lines.mesh.lines = {0, 1, 1, 2, 1, 3};
    CHECK(io::drop_not_finite(lines).lines == 1);
    CHECK(lines.mesh.lines == std::vector<Index>{0, 1, 1, 2});
    CHECK(lines.mesh.positions.size() == 3);

    Part sound;
    sound.mesh = shapes::cube();
    CHECK(io::drop_not_finite(sound).vertices == 0);
    CHECK_FALSE(sound.changed);
}
