#include "io/footprint/footprint.hpp"

#include "base/math/portable_math.hpp"
#include "io/drawing/drawing.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"

#include <cstring>

using namespace facetmill;

namespace {

io::FootprintRings read(const std::string& text) {
    io::Bytes bytes(text.size());
    if (!text.empty()) std::memcpy(bytes.data(), text.data(), text.size());
    return io::read_footprint(io::Input::of("outline", std::move(bytes))).rings;
}
std::string refusal(const std::string& text) {
    return test::failure([&] { read(text); });
}

} // namespace

TEST_CASE("footprints from GeoJSON", "[io]") {
    const char* polygon =
        R"({"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 4, 7], [0, 0]], [[1, 1], [2, 1], [2, 2]]]})";
    const auto rings = read(polygon);
    REQUIRE(rings.size() == 2);
    CHECK(rings[0] == std::vector<Vec2>{{0, 0}, {4, 0}, {4, 4}, {0, 0}});
    const std::string collection =
        std::string(R"({"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": )") +
        polygon + R"(}, {"type": "Feature", "geometry": null}, {"type": "Feature", "geometry":
        {"type": "GeometryCollection", "geometries": [{"type": "Point", "coordinates": [1, 2]},
        {"type": "MultiPolygon", "coordinates": [[[[9, 9], [10, 9], [10, 10]]]]}]}}]})";
    CHECK(read(collection).size() == 3);
    CHECK(refusal(R"({"type": "Polygon", "coordinates": [[[0, "a"]]]})") ==
          "malformed [E-GEOJSON] outline: a position must be a list of two or three numbers");
    CHECK(refusal(R"({"type": "Point", "coordinates": [1, 2]})").starts_with("malformed [E-FOOTPRINT]"));
    CHECK(refusal("{\"type\": ").starts_with("malformed [E-GEOJSON]"));
}

TEST_CASE("what a GeoJSON has besides polygons is named, and so are degrees", "[io]") {
    const auto warnings = [](const std::string& text) {
        io::Bytes bytes(text.size());
        std::memcpy(bytes.data(), text.data(), text.size());
        return io::read_footprint(io::Input::of("outline", std::move(bytes))).warnings;
    };
    const std::string polygon = R"({"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 4]]]})";
    CHECK(warnings(polygon).empty());
    const auto mixed = warnings(R"({"type": "GeometryCollection", "geometries": [)" + polygon +
                                R"(, {"type": "LineString", "coordinates": [[0, 0], [1, 1]]},
        {"type": "Point", "coordinates": [1, 2]}, {"type": "Point", "coordinates": [1, 2]}]})");
    REQUIRE(mixed.size() == 1);
    CHECK(mixed[0].id == "W-FOOTPRINT");
    CHECK(mixed[0].message ==
          "1 LineString and 2 Point geometries are left out: only polygons have an inside");
    const auto in = [&](const char* crs) {
        return warnings(polygon.substr(0, polygon.size() - 1) +
                        R"(, "crs": {"type": "name", "properties": {"name": ")" + crs + "\"}}}");
    };
    REQUIRE(in("urn:ogc:def:crs:OGC:1.3:CRS84").size() == 1);
    CHECK(in("EPSG:4326").at(0).id == "W-FOOTPRINT");
    CHECK(in("urn:ogc:def:crs:EPSG::25832").empty());
}

TEST_CASE("footprints from WKT", "[io]") {
    const auto rings = read("SRID=4326;POLYGON Z((0 0 5, 4 0 5, 4 4 5), (1 1 5,2 1 5,2 2 5))\n");
    REQUIRE(rings.size() == 2);
    CHECK(rings[1] == std::vector<Vec2>{{1, 1}, {2, 1}, {2, 2}});
    CHECK(read("multipolygon (((0 0, 1e1 0, 1 1)), ((5 5, 6 5, 6 6)))").size() == 2);
    CHECK(refusal("POLYGON EMPTY").starts_with("malformed [E-FOOTPRINT]"));
    CHECK(refusal("POLYGON ((0 0, 1 x))") ==
          "malformed [E-WKT] outline:1: expected a number at character 18");
    CHECK(refusal("POLYGON ((0 0, 1 1") == "malformed [E-WKT] outline:1: expected ')' at character 19");
    // A comma is missing: these four are no position of heights and measures.
    CHECK(refusal("POLYGON ((0 0 1 0, 1 1, 0 1))") ==
          "malformed [E-WKT] outline:1: expected a position of 4 numbers, found 2 at character 23");
    CHECK(refusal("POLYGON ((0 0 1 0 1 1))") ==
          "malformed [E-WKT] outline:1: expected a position of 4 numbers, found 6 at character 22");
    CHECK(
        refusal("LINESTRING (0 0, 1 1)") ==
        "malformed [E-WKT] outline:1: expected POLYGON or MULTIPOLYGON, found 'LINESTRING' at character 11");
    CHECK(io::is_wkt("GeometryCollection(POINT(0 0))"));
    CHECK_FALSE(io::is_wkt("point.dxf"));
}

TEST_CASE("footprints from DXF", "[io]") {
    const std::string head = "0\nSECTION\n2\nENTITIES\n";
    const auto rings =
        read(head + "0\nLWPOLYLINE\n8\n0\n90\n3\n70\n1\n10\n0\n20\n0\n10\n4\n20\n0\n10\n4\n20\n3\n"
                    "0\nLINE\n10\n0\n20\n0\n11\n1\n21\n1\n0\nENDSEC\n0\nEOF\n");
    REQUIRE(rings.size() == 1);
    CHECK(rings[0] == std::vector<Vec2>{{0, 0}, {4, 0}, {4, 3}});
    const auto circle = read(head + "0\nCIRCLE\n10\n1\n20\n2\n40\n3\n0\nEOF\n");
    REQUIRE(circle.size() == 1);
    CHECK(circle[0].size() == 72);
    for (const Vec2& p : circle[0]) CHECK(length(p - Vec2{1, 2}) == Approx(3));
    const auto arc = read(head + "0\nLWPOLYLINE\n70\n1\n10\n0\n20\n0\n42\n1\n10\n2\n20\n0\n0\nEOF\n");
    CHECK(polygon::signed_area(arc.at(0)) == Approx(pi / 2).epsilon(0.002)); // a half circle of radius 1
    CHECK(refusal(head + "0\nLINE\n10\n0\n20\n0\n0\nEOF\n")
              .starts_with("malformed [E-FOOTPRINT] outline: the file contains no polygon"));
    CHECK(refusal(head + "0\nLWPOLYLINE\n70\n1\n10\nwide\n").starts_with("malformed [E-DXF] outline:"));
    CHECK(refusal("hello") ==
          "malformed [E-FOOTPRINT] outline: this is neither GeoJSON nor WKT nor DXF as text | a "
          "footprint is a POLYGON or MULTIPOLYGON, or outlines of a DXF");
}

TEST_CASE("outlines of a DXF drawn from behind, in blocks, and out of the plane", "[io]") {
    const auto outline = [](const std::string& looks) {
        return "0\nLWPOLYLINE\n70\n1\n" + looks + "10\n-2\n20\n0\n42\n1\n10\n-4\n20\n0\n";
    };
    const std::string entities = "0\nSECTION\n2\nENTITIES\n", end = "0\nENDSEC\n0\nEOF\n",
                      behind = "210\n0\n220\n0\n230\n-1\n";
    const auto plain = read(entities + outline("") + end), mirrored = read(entities + outline(behind) + end);
    REQUIRE(mirrored.size() == 1);
    REQUIRE(mirrored[0].size() == plain.at(0).size());
    for (std::size_t i = 0; i < plain[0].size(); ++i)
        CHECK(mirrored[0][i] == Vec2{-plain[0][i].x, plain[0][i].y});
    // A block is drawn where it is inserted, and nowhere else.
    CHECK(
        read("0\nSECTION\n2\nBLOCKS\n" + outline("") + "0\nENDSEC\n" + entities + outline("") + end).size() ==
        1);
    CHECK(refusal(entities + outline("210\n1\n220\n0\n230\n0\n") + end) ==
          "malformed [E-DXF] outline:6: a closed outline is not in the drawing's plane");
}

TEST_CASE("a ring that repeats another one is left out", "[io]") {
    // The same square from another corner, the other way round, and with one more corner.
    CHECK(read("POLYGON ((0 0, 4 0, 4 4, 0 4)); POLYGON ((4 4, 4 0, 2 0, 0 0, 0 4))").size() == 1);
    // The corners and areas of these two are the same, but their notches are on different sides.
    CHECK(read("MULTIPOLYGON (((0 0, 2 2, 4 0, 4 4, 0 4)), ((0 0, 4 0, 4 4, 2 2, 0 4)))").size() == 2);
}

TEST_CASE("a section's drawing is a footprint", "[io]") {
    io::Drawing drawing{"cut", Unit::mm, {}};
    SectionSettings settings;
    settings.plane = {{0, 0, 1}, {0, 0, 0.5}, 0};
    auto sections = section(shapes::cube(), settings);
    drawing.sheets.push_back({0, sections[0].frame, {}});
    drawing.sheets[0].parts.push_back({"cube", std::move(sections[0]), {}});
    const auto rings = read(io::to_dxf(drawing));
    REQUIRE(rings.size() == 1);
    CHECK(polygon::signed_area(rings[0]) == 1);
}
