// COLOR_0 is linear in scenes and in glTF, and sRGB in the files of all other formats.
#include "support/catch.hpp"

#include "geometry/render/srgb.hpp"
#include "mesh/shapes.hpp"
#include "support/colours.hpp"
#include "support/gltf.hpp"

#include <fmt/format.h>
#include <set>
#include <sstream>

using namespace facetmill;
using namespace facetmill::test;

namespace {

/// Points of a PLY whose colours have all 256 values, with their complements as green, and an alpha.
std::string ply_of_all_bytes() {
    std::string text = "ply\nformat ascii 1.0\nelement vertex 256\nproperty float x\nproperty float y\n"
                       "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                       "property uchar alpha\nend_header\n";
    for (int i = 0; i < 256; ++i) text += fmt::format("{0} 0 0 {0} {1} 128 {0}\n", i, 255 - i);
    return text;
}

const Attribute& colours_of(const Scene& scene) {
    const Mesh& mesh = scene.parts.at(0).mesh;
    const Attribute* a = mesh.find("COLOR_0", Domain::wedge);
    if (!a) a = mesh.find("COLOR_0", Domain::face);
    REQUIRE(a);
    return *a;
}

Scene again(const Scene& scene, const char* format) {
    return read_bytes(written(scene, format).files.at(0).bytes, format);
}

std::string text_of(const Scene& scene, const char* format) {
    const auto bytes = written(scene, format, {.ascii = true}).files.at(0).bytes;
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The lines after the header, in any order.
std::multiset<std::string> rows_of(const std::string& ply) {
    std::istringstream rows(ply.substr(ply.find("end_header\n") + 11));
    std::multiset<std::string> all;
    for (std::string row; std::getline(rows, row);) all.insert(row);
    return all;
}

} // namespace

TEST_CASE("colours of a PLY are linear in a scene and in glTF, and come back as all 256 bytes", "[io]") {
    const Scene ply = read_bytes(to_bytes(ply_of_all_bytes()), "ply");
    const Scene glb = again(ply, "glb");
    for (const Scene* scene : {&ply, &glb}) {
        const Attribute& a = colours_of(*scene);
        CHECK(a.type() == std::string("uint16"));
        for (std::size_t i = 0; i < 256; ++i) {
            const auto at = static_cast<std::size_t>(
                std::lround(scene->parts[0]
                                .mesh.positions[scene->parts[0].mesh.vertex_of_wedge(static_cast<Index>(i))]
                                .x));
            const double x = static_cast<double>(at) / 255;
            CHECK(std::abs(a.value(i, 0) - linear_light(x)) <= 0.5 / 65535);
            CHECK(std::abs(a.value(i, 1) - linear_light(1 - x)) <= 0.5 / 65535);
            CHECK(std::abs(a.value(i, 2) - 0.2158605) <= 0.5 / 65535); // 128 of 255
            CHECK(a.value(i, 3) == x);                                 // alpha is linear everywhere
        }
        const std::string back = text_of(*scene, "ply");
        CHECK(back.find("property uchar red") != back.npos);
        CHECK(rows_of(back) == rows_of(ply_of_all_bytes()));
    }
}

TEST_CASE("every format of sRGB colours takes them to glTF and back", "[io]") {
    Scene scene;
    scene.unit = Unit::mm;
    Mesh& mesh = scene.parts.emplace_back().mesh;
    mesh = shapes::tetrahedron();
    const std::vector<std::uint8_t> bytes{1, 2, 3, 10, 11, 12, 128, 64, 200, 254, 255, 0};
    for (const auto& [format, domain] :
         {std::pair{"ply", Domain::wedge}, std::pair{"ply", Domain::face}, std::pair{"off", Domain::wedge},
          std::pair{"off", Domain::face}, std::pair{"3mf", Domain::wedge}, std::pair{"drc", Domain::wedge},
          std::pair{"obj", Domain::wedge}}) {
        INFO(format);
        mesh.attributes = {{"COLOR_0", domain, Role::colour, 3, true, linear_words(bytes, 3)}};
        const Scene from = again(again(scene, format), format);
        const Attribute& a = colours_of(from);
        const Mesh& found = from.parts[0].mesh;
        for (std::size_t i = 0; i < a.size(); ++i) {
            std::size_t at = i; // Draco may have another order
            if (domain == Domain::wedge)
                for (at = 0; length(mesh.positions[at] -
                                    found.positions[found.vertex_of_wedge(static_cast<Index>(i))]) > 1e-3;)
                    ++at;
            for (int c = 0; c < 3; ++c)
                CHECK(srgb_byte(a, i, c) == bytes[3 * at + static_cast<std::size_t>(c)]);
        }
    }
}

TEST_CASE("sRGB fractions of any precision come back", "[io]") {
    for (int i = 0; i <= 2000; ++i) {
        const double x = i / 1000.0; // overbright, too
        CHECK(std::abs(linear_fraction(x) - linear_light(x)) < 1e-15 * std::max(1.0, linear_light(x)) * 8);
        CHECK(std::abs(srgb_fraction(linear_fraction(x)) - x) < 1e-6); // the two pieces meet within this
    }
    CHECK(std::isnan(linear_fraction(NAN)));
    CHECK(std::isnan(srgb_fraction(NAN)));
    Scene scene;
    Mesh& mesh = scene.parts.emplace_back().mesh;
    mesh = shapes::tetrahedron();
    mesh.attributes = {{"COLOR_0", Domain::wedge, Role::colour, 3, false,
                        std::vector<float>{0, 0.25F, 0.5F, 1, 1.5F, 0.001F, 0, 0, 0, 0, 0, 0}}};
    const Attribute from = colours_of(again(scene, "ply"));
    CHECK(from.type() == std::string("float32"));
    for (int c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < 2; ++i)
            CHECK(from.value(i, c) == Approx(mesh.attributes[0].value(i, c)).epsilon(1e-6));
}
