#include "support/catch.hpp"

#include "io/drawing/drawing.hpp"
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
    CHECK(j["unit"] == to_string(Unit::inch));
    const Json& c = j["sections"][0]["parts"][0]["contours"][0];
    CHECK(c["points"].size() == 4);
    CHECK(c["kind"] == "quad");
    CHECK(c["orientation"] == "anticlockwise");
    CHECK(c["centroid"]["world"] == Json::array({0.5, 0.5, 0.5}));
    CHECK(c["second_moments"]["about_centroid"]["x"].get<double>() == Approx(1.0 / 12));
    const Json &about = c["second_moments"]["about_origin"]["world"],
               &central = c["second_moments"]["about_centroid"]["world"];
    CHECK(about["xx"].get<double>() == Approx(1.0 / 3));
    for (const char* product : {"zz", "xy", "xz", "yz"}) CHECK(about[product].get<double>() == Approx(0.25));
    CHECK(central["yy"].get<double>() == Approx(1.0 / 12));
    for (const char* product : {"zz", "xy", "xz", "yz"}) CHECK(central[product].get<double>() == 0);
}

TEST_CASE("second moments in the world are those of the points there", "[io]") {
    const Plane plane{{1, 2, 3}, {0.4, 0.5, 0.6}, 0};
    const Section s = section(shapes::cube(), {plane, {0}, {}}).at(0);
    const Drawing drawing{"cut", Unit::unknown, {{0, frame_of(plane), {{"cube", s, {}}}}}};
    const Json c = Json::parse(to_json(drawing))["sections"][0]["parts"][0]["contours"][0];
    // For a polygon: the sum over a fan of triangles of A / 12 (s s^T + the sum of p p^T over the corners).
    // s is the sum of the corners.
    double xz = 0, yy = 0;
    const auto ring = s.ring(s.contours[0]);
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
        const Vec3 p = s.frame.point(ring[0]), q = s.frame.point(ring[i]), r = s.frame.point(ring[i + 1]);
        const double area = length(cross(q - p, r - p)) / 2;
        const Vec3 sum = p + q + r;
        xz += area / 12 * (p.x * p.z + q.x * q.z + r.x * r.z + sum.x * sum.z);
        yy += area / 12 * (p.y * p.y + q.y * q.y + r.y * r.y + sum.y * sum.y);
    }
    const Json& world = c["second_moments"]["about_origin"]["world"];
    CHECK(world["xz"].get<double>() == Approx(xz).epsilon(1e-13));
    CHECK(world["yy"].get<double>() == Approx(yy).epsilon(1e-13));
}

TEST_CASE("other extensions are refused", "[io]") {
    CHECK(test::failure([] { drawing_for("a.pdf", {}); }) ==
          "usage [E-DRAWING] sections are not written as 'a.pdf' | the formats are .svg, .dxf and .json");
}
