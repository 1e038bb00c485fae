#include "support/catch.hpp"

#include "io/codec.hpp"
#include "io/other_formats.hpp"

using namespace facetmill;
using io::hint_for_reading;
using io::hint_for_writing;

TEST_CASE("a format that is not read is named with what to export or to convert it with", "[io]") {
    CHECK(hint_for_reading("scans/a.LAS") ==
          "its name suggests a cloud of points: convert it to .ply, with CloudCompare or PDAL, which can "
          "also make a surface from points");
    CHECK(hint_for_reading("a.fbx").find("export it as glTF (.glb)") != std::string::npos);
    CHECK(hint_for_reading("a.blend.gz").find("Blender") != std::string::npos);
    CHECK(hint_for_reading("a.step").find("FreeCAD") != std::string::npos);
    CHECK(hint_for_reading("a.usdc").find("a USD file") != std::string::npos);
    for (const char* name : {"a.stl", "a", "step", "astep", ".", "a.unheard"})
        CHECK(hint_for_reading(name).empty());
}

TEST_CASE("in place of a format that is not written one is named that is", "[io]") {
    CHECK(hint_for_writing("a.fbx") == "write .glb, which Blender and others open and convert");
    CHECK(hint_for_writing("a.step").find("write .stl or .3mf") != std::string::npos);
    CHECK(hint_for_writing("a.usda").find("write .usdz") != std::string::npos);
    CHECK(hint_for_writing("a.zip").empty());
    CHECK(hint_for_writing("a.glb").empty());
}

TEST_CASE("what is read by its content is read whatever its name", "[io]") {
    const std::string text = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    io::ReadLog log;
    const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
    CHECK(io::read_scene(io::Input::of("a.xyz", {bytes, bytes + text.size()}), {}, log).parts.size() == 1);
}
