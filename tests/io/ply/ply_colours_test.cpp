// Colours whose type does not tell their range, and splats.
#include "support/catch.hpp"

#include "geometry/render/srgb.hpp"
#include "io/codec.hpp"
#include "support/gltf.hpp"

#include <fmt/format.h>

using namespace facetmill;

namespace {

Scene read(const std::string& text, io::ReadLog& log) {
    return io::read_scene(io::Input::of("a.ply", test::to_bytes(text)), {}, log);
}

/// The colours of two points, as fractions of sRGB.
std::vector<double> colours(const std::string& type, const std::string& first, const std::string& second) {
    io::ReadLog log;
    const Scene scene =
        read(fmt::format("ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                         "property float z\nproperty {0} red\nproperty {0} green\nproperty {0} blue\n"
                         "end_header\n0 0 0 {1}\n1 0 0 {2}\n",
                         type, first, second),
             log);
    CHECK(log.warnings.empty());
    const Attribute* a = scene.parts.at(0).mesh.find("COLOR_0", Domain::wedge);
    REQUIRE(a);
    std::vector<double> all;
    for (Index w = 0; w < 2; ++w)
        for (int c = 0; c < 3; ++c) all.push_back(srgb_fraction(a->value(w, c)));
    return all;
}

} // namespace

TEST_CASE("all colours of a PLY together show the value of full brightness", "[io]") {
    // Linear colours of 16 bits are 1/65535 apart, which is up to 2e-4 in sRGB.
    const auto same = [](double x) { return Approx(x).margin(1.1e-4).epsilon(1e-6); };
    const auto half = colours("float", "1 0.5 0", "0 0 0");
    CHECK(half[0] == same(1));
    CHECK(half[1] == same(0.5));
    CHECK(half[2] == 0);
    CHECK(colours("float", "1.5 0.5 0", "0 0 0").at(0) == same(1.5)); // overbright
    CHECK(colours("float", "255 127.5 0", "1 0.5 0")[1] == same(0.5));
    CHECK(colours("double", "255 127.5 0", "51 0 0")[3] == same(0.2));
    CHECK(colours("float", "65535 0 0", "255 0 0")[3] == same(255.0 / 65535));
    CHECK(colours("int", "255 0 0", "51 0 0")[3] == same(0.2));
    CHECK(colours("int", "65535 0 0", "13107 0 0")[3] == same(0.2));
    CHECK(colours("uchar", "255 0 0", "1 0 0")[3] == same(1.0 / 255)); // the type tells it
}

TEST_CASE("Gaussian splats are named, because no stage turns them", "[io]") {
    std::string header = "ply\nformat ascii 1.0\nelement vertex 1\n", values;
    for (const char* name : {"x", "y", "z", "f_dc_0", "opacity", "scale_0", "scale_1", "scale_2", "rot_0",
                             "rot_1", "rot_2", "rot_3"}) {
        header += fmt::format("property float {}\n", name);
        values += "0 ";
    }
    io::ReadLog log;
    CHECK(read(header + "end_header\n" + values + "\n", log).parts.size() == 1);
    REQUIRE(log.warnings.size() == 1);
    CHECK(log.warnings[0].id == "W-SPLATS");
}
