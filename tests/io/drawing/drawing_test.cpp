#include "support/catch.hpp"

#include "io/drawing/drawing.hpp"
#include "mesh/shapes.hpp"
#include "support/failure.hpp"

#include <cmath>

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
          "usage [E-DRAWING] sections are not written as 'a.pdf' | the formats are .svg, .dxf, .geojson and "
          ".json");
}

namespace {

/// A slope z = 400 + x / 2 over [0, 8] x [0, 8], far from the origin, cut by planes.
Drawing slope(const Plane& plane, std::vector<double> heights, DrawingLayout layout, UpAxis up = UpAxis::z) {
    Mesh mesh = shapes::grid(8, 8);
    for (Vec3& p : mesh.positions) {
        p = {p.x + 500000, p.y + 5200000, 400 + p.x / 2};
        if (up == UpAxis::y) p = {p.x, p.z, -p.y};
    }
    Drawing drawing{"slope", Unit::m, {}, up, layout};
    for (auto& s : section(mesh, {plane, heights, {}}))
        drawing.sheets.push_back({s.height, s.frame, {{"ground", std::move(s), {}}}});
    return drawing;
}

} // namespace

TEST_CASE("contours lie over each other, to scale, with their heights", "[io]") {
    for (const UpAxis up : {UpAxis::z, UpAxis::y}) {
        const Vec3 normal = up == UpAxis::y ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
        const Drawing drawing =
            slope({normal, normal * 400, 0}, {1, 2.5, 3}, {DrawingLayout::Kind::contours, 100, 1}, up);
        const std::string svg = to_svg(drawing), dxf = to_dxf(drawing);
        // The lines are at x = 2, 5 and 6: 4 m wide and 8 m high, with a margin of 0.4 m.
        CHECK(holds(svg, "width=\"48mm\" height=\"88mm\" viewBox=\"0 0 4.8 8.8\""));
        CHECK(holds(svg, "printed at 1:100"));
        CHECK(holds(
            svg,
            "data-height=\"2.5\" data-elevation=\"402.5\" transform=\"translate(0.4 8.4) scale(1 -1)\""));
        CHECK(holds(svg, ">402.5</text>"));
        CHECK_FALSE(holds(svg, "class=\"open\""));
        CHECK(holds(dxf, "CONTOUR_402_5\n"));
        CHECK(holds(dxf, "10\n500005\n20\n5200008\n30\n402.5\n"));
        const Json json = Json::parse(to_geojson(drawing));
        REQUIRE(json["features"].size() == 3);
        const Json& feature = json["features"][1];
        CHECK(feature["properties"]["elevation"] == 402.5);
        CHECK(feature["properties"]["part"] == "ground");
        CHECK(feature["properties"]["closed"] == false);
        for (const Json& p : feature["geometry"]["coordinates"]) {
            CHECK(p[0] == 500005);
            CHECK(std::abs(p[1].get<double>()) >= 5200000);
            CHECK(p[2] == 402.5);
        }
    }
}

TEST_CASE("a profile runs from 0, with exaggerated elevations", "[io]") {
    for (const Vec3 normal : {Vec3{0, 1, 0}, Vec3{0, -1, 0}}) {
        const Drawing drawing =
            slope({normal, {0, 5200004, 0}, 0}, {0}, {DrawingLayout::Kind::profile, 100, 10});
        const Paper paper(drawing);
        CHECK(paper.bounds().min == Vec3{0, 4000, 0});
        CHECK(paper.bounds().max == Vec3{8, 4040, 0});
        const std::string svg = to_svg(drawing), dxf = to_dxf(drawing);
        CHECK(holds(svg, "viewBox=\"0 0 12 44\""));
        CHECK(holds(svg, ">5</text>"));
        CHECK(holds(svg, ">402</text>"));
        CHECK(holds(dxf, "10\n8\n20\n4040\n30\n0\n"));
        CHECK_FALSE(Json::parse(to_geojson(drawing))["features"][0]["properties"].contains("elevation"));
    }
}
