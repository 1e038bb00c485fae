#include "io/attributes.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/colours.hpp"
#include "support/failure.hpp"
#include "support/gltf.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

/// A tetrahedron in a binary file, with these attribute bytes.
io::Bytes binary_stl(const std::string& head, const std::array<std::uint16_t, 4>& bits,
                     std::uint32_t count = 4) {
    io::Bytes bytes = written(scene_in_metres(shapes::tetrahedron()), "stl").files.at(0).bytes;
    REQUIRE(bytes.size() == 84 + 4 * 50);
    std::memset(bytes.data(), 0, 80);
    std::memcpy(bytes.data(), head.data(), head.size());
    std::memcpy(bytes.data() + 80, &count, sizeof count);
    for (std::size_t t = 0; t < bits.size(); ++t) std::memcpy(bytes.data() + 84 + 50 * t + 48, &bits[t], 2);
    return bytes;
}

std::vector<std::uint8_t> colours_of_faces(const Scene& scene) {
    const Attribute* a = scene.parts.at(0).mesh.find("COLOR_0", Domain::face);
    REQUIRE(a);
    CHECK(a->role == Role::colour);
    CHECK(a->components == 3);
    std::vector<std::uint8_t> bytes;
    for (std::size_t f = 0; f < a->size(); ++f)
        for (int c = 0; c < 3; ++c) bytes.push_back(static_cast<std::uint8_t>(srgb_byte(*a, f, c)));
    return bytes;
}

std::vector<std::string> ids_of(const io::ReadLog& log) {
    std::vector<std::string> ids;
    for (const auto& w : log.warnings) ids.push_back(w.id);
    return ids;
}

} // namespace

TEST_CASE("colours of STL faces are read as VisCAM and Magics write them", "[io]") {
    using Bytes = std::vector<std::uint8_t>;
    // Blue is lowest, and the highest bit says that there is a colour; a face without one is white.
    const Scene viscam = read_bytes(binary_stl("", {0xfc00, 0x83e0, 0x8010, 0}), "stl");
    CHECK(colours_of_faces(viscam) == Bytes{255, 0, 0, 0, 255, 0, 0, 0, 132, 255, 255, 255});
    // Red is lowest, and the highest bit says that the face has the colour of the whole.
    const Scene magics =
        read_bytes(binary_stl("COLOR=\x10\x20\x30\xff", {0x001f, 0x7c00, 0x8000, 0x03e0}), "stl");
    CHECK(colours_of_faces(magics) == Bytes{255, 0, 0, 0, 0, 255, 16, 32, 48, 0, 255, 0});
    for (const Scene* scene : {&viscam, &magics}) {
        const io::Written again = written(*scene, "stl");
        CHECK(again.warnings.empty());
        CHECK(again.changes.empty());
        if (scene == &viscam)
            CHECK(colours_of_faces(read_bytes(again.files[0].bytes, "stl")) == colours_of_faces(*scene));
    }
    const Scene other = read_bytes(binary_stl("", {1, 2, 3, 0}), "stl"); // no colours
    CHECK(other.parts[0].mesh.find(io::stl_attribute, Domain::face));
    CHECK_FALSE(other.parts[0].mesh.find("COLOR_0", Domain::face));
    CHECK(written(other, "stl").warnings.empty());
    const io::Written text = written(viscam, "stl", {.ascii = true});
    REQUIRE(text.warnings.size() == 1);
    CHECK(text.warnings[0].id == "W-ATTRIBUTE");
}

TEST_CASE("an STL is binary if it has bytes of zero, whatever its head begins with", "[io]") {
    io::Bytes bytes = binary_stl("solid base", {0, 0, 0, 0});
    CHECK(read_bytes(bytes, "stl").parts[0].mesh.face_count() == 4);
    bytes.resize(bytes.size() + 7);
    io::ReadLog log;
    CHECK(read_bytes(bytes, "stl", &log).parts[0].mesh.face_count() == 4);
    CHECK(ids_of(log) == std::vector<std::string>{"W-TRAILING"});
}

TEST_CASE("an STL without a count is read whole, and one with too few triangles is refused", "[io]") {
    for (const std::uint32_t count : {0U, UINT32_MAX}) {
        io::ReadLog log;
        const io::Bytes bytes = binary_stl("", {0, 0, 0, 0}, count);
        CHECK(read_bytes(bytes, "stl", &log).parts[0].mesh.face_count() == 4);
        CHECK(ids_of(log) == std::vector<std::string>{"W-COUNT"});
    }
    io::ReadLog log;
    CHECK(read_bytes(binary_stl("", {0, 0, 0, 0}, 3), "stl", &log).parts[0].mesh.face_count() == 3);
    CHECK(ids_of(log) == std::vector<std::string>{"W-TRAILING"});
    CHECK(failure([&] {
              read_bytes(binary_stl("", {0, 0, 0, 0}, 5), "stl");
          }).starts_with("malformed [E-STL]"));
}

TEST_CASE("words after the end of an STL facet are named", "[io]") {
    std::string text = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                       "endloop\nendfacet color 31\nendsolid a\n";
    io::ReadLog log;
    CHECK(read_bytes(to_bytes(text), "stl", &log).parts.at(0).mesh.face_count() == 1);
    CHECK(ids_of(log) == std::vector<std::string>{"W-SKIPPED"});
    io::ReadLog plain;
    text.erase(text.find(" color 31"), 9);
    read_bytes(to_bytes(text), "stl", &plain);
    CHECK(plain.warnings.empty());
}
