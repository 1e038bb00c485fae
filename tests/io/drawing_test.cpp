#include "support/catch.hpp"

#include "io/drawing.hpp"
#include "mesh/shapes.hpp"
#include "support/failure.hpp"

using namespace facetmill;
using namespace facetmill::io;

namespace {

Drawing square(Unit unit) {
    const Plane plane{{0, 0, 1}, {0, 0, 0.5}, 0};
    DrawnPart part{
        "a <cube> & more", section(shapes::cube(), {plane, {0}, {}}).at(0), {{{0, 0.25}, {1, 0.25}}}};
    return {"cut", unit, {{0, frame_of(plane), {part}}}};
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace

TEST_CASE("an SVG is to scale and turned upright", "[io]") {
    const std::string svg = to_svg(square(Unit::cm));
    CHECK(holds(svg, "width=\"1.1cm\" height=\"1.1cm\" viewBox=\"0 0 1.1 1.1\""));
    CHECK(holds(svg, "<desc>1 user unit is 1 cm</desc>"));
    CHECK(holds(svg, "scale(1 -1)"));
    CHECK(holds(svg, "a &lt;cube&gt; &amp; more"));
    CHECK(holds(svg, "class=\"hatch\" d=\"M0 0.25L1 0.25\""));
    CHECK(holds(to_svg(square(Unit::m)), "width=\"1100mm\""));
    CHECK(holds(to_svg({"empty", Unit::mm, {}}), "</svg>"));
}

TEST_CASE("a DXF has closed polylines on layers, at the plane's height", "[io]") {
    const std::string dxf = to_dxf(square(Unit::mm));
    CHECK(holds(dxf, "9\n$INSUNITS\n70\n4\n"));
    CHECK(holds(dxf, "0\nPOLYLINE\n8\nSECTION_1\n66\n1\n10\n0\n20\n0\n30\n0.5\n70\n1\n0\nVERTEX\n"));
    CHECK(holds(dxf, "0\nLINE\n8\nHATCH_1\n10\n0\n20\n0.25\n30\n0.5\n11\n1\n21\n0.25\n31\n0.5\n"));
    CHECK(dxf.ends_with("0\nEOF\n"));
}

TEST_CASE("a JSON drawing has points, measures and frames", "[io]") {
    const Json j = Json::parse(to_json(square(Unit::inch)));
    CHECK(j["unit"] == spelled(Unit::inch));
    const Json& c = j["sections"][0]["parts"][0]["contours"][0];
    CHECK(c["points"].size() == 4);
    CHECK(c["kind"] == "quad");
    CHECK(c["orientation"] == "anticlockwise");
    CHECK(c["centroid"]["world"] == Json::array({0.5, 0.5, 0.5}));
    CHECK(c["second_moments"]["about_centroid"]["x"].get<double>() == Approx(1.0 / 12));
}

TEST_CASE("other extensions are refused", "[io]") {
    CHECK(test::failure([] { drawing_for("a.pdf", {}); }) ==
          "usage [E-DRAWING] sections are not written as 'a.pdf' | the formats are .svg, .dxf and .json");
}
