// Units and up axes in the comments of formats that cannot state them otherwise.
#include "io/stated.hpp"

#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

io::Convention stated_by(std::string_view text, std::string_view keyword = {}) {
    return io::stated_in_lines(text, keyword);
}

Scene cube_in(Unit unit, UpAxis up) {
    Scene scene;
    scene.parts.push_back({.name = "cube", .mesh = shapes::cube()});
    scene.unit = unit;
    scene.up = up;
    return scene;
}

std::string text_of(const io::Bytes& bytes) { return std::string(io::as_text(bytes)); }

} // namespace

TEST_CASE("the unit and the up axis of a scene are read back from what is written", "[io]") {
    for (const char* format : {"obj", "ply", "off", "stl"})
        for (const Unit unit : {Unit::unknown, Unit::um, Unit::mm, Unit::m, Unit::inch, Unit::foot})
            for (const UpAxis up : {UpAxis::unknown, UpAxis::y, UpAxis::z}) {
                INFO(format << " " << to_string(unit) << " " << to_string(up));
                const io::Bytes bytes = written(cube_in(unit, up), format).files.at(0).bytes;
                const Scene again = read_bytes(bytes, format);
                CHECK(again.unit == unit);
                CHECK(again.up == up);
                const auto input = io::Input::of(std::string("cube.") + format, io::Bytes(bytes));
                const io::FileHeader header = io::file_header(input, {});
                CHECK(header.unit == unit);
                CHECK(header.up == up);
                CHECK(io::file_header(input, {.unit = Unit::km, .up = UpAxis::y}).unit == Unit::km);
            }
    // The file of a scene without unit and axis does not state them.
    CHECK(text_of(written(cube_in(Unit::unknown, UpAxis::unknown), "obj").files.at(0).bytes)
              .starts_with("# written by facetmill\no "));
}

TEST_CASE("a comment that states a unit or an axis that is none is told", "[io]") {
    const auto told = [](const std::string& name, std::string_view text,
                         const io::ReadSettings& settings = {}) {
        io::ReadLog log;
        const Scene scene = io::read_scene(io::Input::of(name, to_bytes(std::string(text))), settings, log);
        CHECK(scene.unit == settings.unit.value_or(Unit::unknown));
        std::string all;
        for (const auto& w : log.warnings) all += w.id + ' ' + w.message + '\n';
        return all;
    };
    const std::string obj = "# unit: parsec\n# up: x\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    CHECK(told("a.obj", obj) ==
          "W-UNITS 'a.obj' states the unit 'parsec', which is unknown and therefore ignored\n"
          "W-UP 'a.obj' states the up axis 'x', which is unknown and therefore ignored\n");
    CHECK(told("a.obj", obj, {.unit = Unit::m, .up = UpAxis::z}).empty());
    CHECK(told("a.ply", "ply\nformat ascii 1.0\ncomment unit: parsec\nelement vertex 1\nproperty float x\n"
                        "property float y\nproperty float z\nend_header\n0 0 0\n") ==
          "W-UNITS 'a.ply' states the unit 'parsec', which is unknown and therefore ignored\n");
    CHECK(told("a.off", "OFF\n# units = parsec\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n") ==
          "W-UNITS 'a.off' states the unit 'parsec', which is unknown and therefore ignored\n");
    CHECK(told("a.obj", "# unit:\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").empty());
}

TEST_CASE("load takes what it is given, and tells that a comment states something else", "[io]") {
    const io::Bytes bytes = written(cube_in(Unit::mm, UpAxis::z), "obj").files.at(0).bytes;
    io::ReadLog log;
    const Scene scene =
        io::read_scene(io::Input::of("cube.obj", io::Bytes(bytes)), {.unit = Unit::cm, .up = UpAxis::y}, log);
    CHECK(scene.unit == Unit::cm);
    CHECK(scene.up == UpAxis::y);
    REQUIRE(log.warnings.size() == 2);
    CHECK(log.warnings[0].message ==
          "'cube.obj' states unit mm, but cm is used instead, without a conversion");
    CHECK(log.warnings[1].message == "'cube.obj' states up z, but y is used instead, without a conversion");
    log = {};
    io::read_scene(io::Input::of("cube.obj", io::Bytes(bytes)), {.unit = Unit::mm, .up = UpAxis::z}, log);
    CHECK(log.warnings.empty());
}

TEST_CASE("only comments before the first line of anything else count", "[io]") {
    const auto says = [](const io::Convention& c, Unit unit, UpAxis up) {
        return c.unit == unit && c.up == up;
    };
    CHECK(says(stated_by("# unit: mm\n# up: z\nv 0 0 0\n"), Unit::mm, UpAxis::z));
    CHECK(says(stated_by("\n#unit:in\r\n\r\n  #  up: y  \r\nv 0 0 0"), Unit::inch, UpAxis::y));
    CHECK(says(stated_by("# up: z"), Unit::unknown, UpAxis::z));
    CHECK(says(stated_by("# unit: mm\n# unit: m\n"), Unit::m, UpAxis::unknown));
    CHECK(says(stated_by("v 0 0 0\n# unit: mm\n"), Unit::unknown, UpAxis::unknown));
    CHECK(says(stated_by("# unit: parsec\n# up: x\n# units are mm, up: y\n# up:\n"), Unit::unknown,
               UpAxis::unknown));
    CHECK(says(stated_by(""), Unit::unknown, UpAxis::unknown));
    CHECK(says(stated_by("COFF\n# unit: m\n8 6 12\n# up: y\n", "OFF"), Unit::m, UpAxis::unknown));
    CHECK(says(stated_by("OFF # unit: mm\n# unit: m\n8 6 12\n", "OFF"), Unit::m, UpAxis::unknown));
    CHECK(says(stated_by("OFF\nOFF\n# unit: m\n", "OFF"), Unit::unknown, UpAxis::unknown));
    CHECK(says(stated_by("# unit: mm\r# up: z\rv 0 0 0\r# up: y\r"), Unit::mm, UpAxis::z));
}

TEST_CASE("units in comments are read as people spell them", "[io]") {
    for (const auto& [text, unit] :
         {std::pair{"# Unit: mm\n", Unit::mm}, std::pair{"#UNITS = Millimeters\n", Unit::mm},
          std::pair{"# units: metres", Unit::m}, std::pair{"# Units: inches", Unit::inch},
          std::pair{"# unit: Feet", Unit::foot}, std::pair{"# unit:MICRONS", Unit::um},
          std::pair{"# unit: meteor", Unit::unknown}, std::pair{"# unit: inchworm", Unit::unknown},
          std::pair{"# my unit: mm", Unit::unknown}, std::pair{"# units: 3 mm", Unit::unknown}}) {
        INFO(text);
        CHECK(stated_by(text).unit == unit);
    }
    CHECK(stated_by("# Up: Z\n").up == UpAxis::z);
    CHECK(stated_by("# up axis: z\n").up == UpAxis::unknown);
}
