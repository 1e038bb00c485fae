#include "support/catch.hpp"
#include "support/gltf.hpp"

#include "mesh/shapes.hpp"

using namespace facetmill;

namespace {

/// The messages about bytes after the contents, of a file with more at its end.
std::vector<std::string> told(io::Bytes bytes, const char* codec, std::string_view more) {
    for (const char c : more) bytes.push_back(std::byte(c));
    io::ReadLog log;
    const Scene scene = test::read_bytes(std::move(bytes), codec, &log);
    CHECK(scene.parts.at(0).mesh.face_count() == 4);
    std::vector<std::string> messages;
    for (const auto& warning : log.warnings)
        if (warning.id == std::string("W-TRAILING")) messages.push_back(warning.message);
    return messages;
}

} // namespace

TEST_CASE("bytes after the contents of a file are named", "[io]") {
    using Messages = std::vector<std::string>;
    Scene scene = test::scene_in_metres(shapes::tetrahedron());
    const auto bytes = [&](const char* codec) { return test::written(scene, codec).files.at(0).bytes; };
    CHECK(told(bytes("ply"), "ply", "3 0 1 2\n") == Messages{"8 bytes after the last element are skipped"});
    CHECK(told(bytes("ply"), "ply", "\r\n").empty());
    CHECK(told(bytes("off"), "off", "OFF\n") == Messages{"4 bytes after the last face are skipped"});
    CHECK(told(bytes("off"), "off", "\n \n").empty());
    CHECK(told(bytes("stl"), "stl", "more") == Messages{"4 bytes after the last of 4 triangles are skipped"});
    CHECK(told(bytes("glb"), "glb", "more") == Messages{"4 bytes after the JSON and the buffer are skipped"});
    CHECK(told(bytes("glb"), "glb", "").empty());
}

TEST_CASE("numbers of a colour map in an OFF are named", "[io]") {
    io::ReadLog log;
    test::read_bytes(test::to_bytes("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 5\n"), "off", &log);
    REQUIRE(log.warnings.size() >= 1);
    CHECK(log.warnings[0].message == "colours that are numbers of a colour map are skipped (1)");
}
