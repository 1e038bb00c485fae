#include "io/footprint/footprint.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/polygon/footprint.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"

#include <cstring>
#include <fmt/format.h>

using namespace facetmill;

namespace {

/// A DXF of these entities, without heights.
class DxfText {
  public:
    DxfText& group(int code, const std::string& value) {
        text_ += fmt::format("{}\n{}\n", code, value);
        return *this;
    }
    DxfText& group(int code, double value) { return group(code, fmt::format("{:.6f}", value)); }
    DxfText& point(int code, double x, double y) { return group(code, x).group(code + 10, y); }
    DxfText& line(Vec2 a, Vec2 b, const char* layer = "0") {
        return group(0, "LINE").group(8, layer).point(10, a.x, a.y).point(11, b.x, b.y);
    }
    DxfText& arc(Vec2 centre, double radius, double from, double to) {
        return group(0, "ARC").point(10, centre.x, centre.y).group(40, radius).group(50, from).group(51, to);
    }
    DxfText& circle(Vec2 centre, double radius) {
        return group(0, "CIRCLE").point(10, centre.x, centre.y).group(40, radius);
    }
    DxfText& square(Vec2 low, double size, const char* layer = "0") {
        const Vec2 x{size, 0}, y{0, size};
        return line(low, low + x, layer)
            .line(low + x + y, low + x, layer) // against the others
            .line(low + x + y, low + y, layer)
            .line(low + y, low, layer);
    }
    DxfText& block(const std::string& name) { return group(0, "BLOCK").group(2, name).point(10, 0, 0); }
    DxfText& insert(const std::string& name, Vec2 at) {
        return group(0, "INSERT").group(2, name).point(10, at.x, at.y);
    }
    DxfText& section(const char* name) { return group(0, "SECTION").group(2, name); }
    DxfText& end(const char* what = "ENDSEC") { return group(0, what); }
    std::string text() const { return text_; }

  private:
    std::string text_;
};

DxfText dxf_entities() { return std::move(DxfText().section("ENTITIES")); }

io::FootprintFile read_dxf(DxfText& drawing) {
    const std::string text = drawing.end().end("EOF").text();
    io::Bytes bytes(text.size());
    std::memcpy(bytes.data(), text.data(), text.size());
    return io::read_footprint(io::Input::of("plate.dxf", std::move(bytes)));
}
double area_of_dxf(const io::FootprintFile& file) { return Footprint(file.rings).area(); }
std::string refusal_of_dxf(DxfText& drawing) {
    return test::failure([&] { static_cast<void>(read_dxf(drawing)); });
}
/// Of a circle in segments of 5 degrees.
double circle_area(double radius) { return 36 * radius * radius * sine(pi / 36); }

} // namespace

TEST_CASE("lines, arcs and circles of a DXF form a plate with holes", "[io]") {
    CHECK(area_of_dxf(read_dxf(dxf_entities().square({10, 10}, 60).circle({40, 40}, 10))) ==
          Approx(3600 - circle_area(10)));
    // Rounded corners: the ends of the arcs are rounded to six digits in the file.
    auto rounded = dxf_entities();
    rounded.line({10, 0}, {90, 0}).arc({90, 10}, 10, 270, 0).line({100, 10}, {100, 40});
    rounded.arc({90, 40}, 10, 0, 90).line({10, 50}, {90, 50}).arc({10, 40}, 10, 90, 180);
    rounded.line({0, 40}, {0, 10}).arc({10, 10}, 10, 180, 270).circle({20, 25}, 5);
    const auto file = read_dxf(rounded);
    CHECK(file.rings.size() == 2);
    CHECK(file.warnings.empty());
    CHECK(area_of_dxf(file) == Approx(5000 - 400 + circle_area(10) - circle_area(5)));
    auto sector = dxf_entities();
    const double third = pi / 3 * 0.555; // 33.3 degrees
    sector.line({0, 0}, {100, 0})
        .arc({0, 0}, 100, 0, 33.3)
        .line({100 * cosine(third), 100 * sine(third)}, {0, 0});
    CHECK(area_of_dxf(read_dxf(sector)) == Approx(7 * 5000 * sine(third / 7)).epsilon(1e-6));
}

TEST_CASE("curves of a DXF keep their shapes", "[io]") {
    auto half = dxf_entities();
    half.group(0, "ELLIPSE").point(10, 0, 0).point(11, 20, 0).group(40, 0.5).group(41, 0.0).group(42, pi);
    half.line({20, 0}, {-20, 0});
    CHECK(area_of_dxf(read_dxf(half)) == Approx(circle_area(1) / 2 * 200).epsilon(1e-3));
    auto spline = dxf_entities(); // a Bezier curve; the area below it is 990
    spline.group(0, "SPLINE").group(70, "8").group(71, "3");
    for (const double knot : {0, 0, 0, 0, 1, 1, 1, 1}) spline.group(40, knot);
    spline.point(10, 0, 0).point(10, 10, 30).point(10, 50, 30).point(10, 60, 0).line({60, 0}, {0, 0});
    CHECK(area_of_dxf(read_dxf(spline)) == Approx(990).epsilon(0.002));
    auto bulge = dxf_entities(); // two open polylines whose ends meet
    bulge.group(0, "LWPOLYLINE").point(10, 0, 0).group(42, 1.0).point(10, 10, 0).point(10, 10, 30);
    bulge.group(0, "LWPOLYLINE").point(10, 10, 30).group(42, 1.0).point(10, 0, 30).point(10, 0, 0);
    CHECK(area_of_dxf(read_dxf(bulge)) == Approx(300 + circle_area(5)));
    auto behind = dxf_entities(); // drawn from the back, so x is reversed
    behind.line({100, 0}, {100, 10}).arc({-100, 5}, 5, 90, 270);
    behind.group(210, 0.0).group(220, 0.0).group(230, -1.0);
    CHECK(area_of_dxf(read_dxf(behind)) == Approx(circle_area(5) / 2));
    CHECK(refusal_of_dxf(dxf_entities().group(0, "SPLINE").group(71, "3").group(40, 0.0).point(10, 0, 0)) ==
          "malformed [E-DXF] plate.dxf:6: a spline has knots or weights that do not fit its points");
    // A spline of points on it is named, though the sheet of paper has an entity, too.
    auto fitted = dxf_entities();
    fitted.group(0, "SPLINE").group(71, "3").point(11, 0, 0).point(11, 5, 5).point(11, 0, 0);
    fitted.group(0, "VIEWPORT_OF_ANOTHER").group(67, "1");
    CHECK(refusal_of_dxf(fitted).find("1 fit-point SPLINE entity is left out: only lines,") !=
          std::string::npos);
}

TEST_CASE("blocks of a DXF are drawn where they are inserted", "[io]") {
    const auto blocks = [] {
        return std::move(DxfText()
                             .section("BLOCKS")
                             .block("PLATE")
                             .square({0, 0}, 10)
                             .end("ENDBLK")
                             .block("PAIR")
                             .insert("plate", {0, 0})
                             .insert("PLATE", {20, 0})
                             .group(41, 2.0)
                             .end("ENDBLK")
                             .end()
                             .section("ENTITIES"));
    };
    CHECK(area_of_dxf(read_dxf(blocks().insert("PLATE", {0, 0}).circle({5, 5}, 2))) ==
          Approx(100 - circle_area(2)));
    const auto file = read_dxf(blocks().insert("PAIR", {0, 0}).group(50, 90.0));
    REQUIRE(file.rings.size() == 2);
    CHECK(area_of_dxf(file) == 300);
    CHECK(Footprint(file.rings).locate({-5, 35}) == polygon::PointLocation::inside);
    auto array = blocks();
    array.insert("PLATE", {0, 0})
        .group(41, -0.5)
        .group(70, "3")
        .group(71, "2")
        .group(44, 8.0)
        .group(45, 12.0);
    const auto many = read_dxf(array);
    CHECK(many.rings.size() == 6);
    CHECK(area_of_dxf(many) == 300);
    CHECK(Footprint(many.rings).locate({12, 15}) == polygon::PointLocation::inside);
    CHECK(refusal_of_dxf(blocks().insert("NONE", {0, 0})) ==
          "malformed [E-DXF] plate.dxf:98: the block 'NONE' is inserted but not defined");
    auto loop = DxfText().section("BLOCKS").block("A").insert("A", {0, 0}).end("ENDBLK").end();
    CHECK(refusal_of_dxf(loop.section("ENTITIES").insert("A", {0, 0}))
              .find("blocks are nested too deeply, or the block 'A' contains itself") != std::string::npos);
    auto bomb = blocks().insert("PLATE", {0, 0}).group(70, "32767").group(71, "32767");
    CHECK(refusal_of_dxf(bomb).starts_with("limit [E-SIZE]"));
}

TEST_CASE("lines of a DXF that enclose nothing are named", "[io]") {
    const auto file =
        read_dxf(dxf_entities().square({0, 0}, 60).line({60, 60}, {90, 90}).line({-20, 30}, {80, 30}));
    REQUIRE(file.warnings.size() == 1);
    CHECK(file.warnings[0].id == "W-FOOTPRINT");
    CHECK(file.warnings[0].message ==
          "2 LINE entities are open and left out; the first reaches from (60, 60) to (90, 90)");
    CHECK(area_of_dxf(file) == 3600);
    // The symbol of a thread around a hole is no outline.
    CHECK(area_of_dxf(
              read_dxf(dxf_entities().square({0, 0}, 60).circle({30, 30}, 5).arc({30, 30}, 6, 0, 270))) ==
          Approx(3600 - circle_area(5)));
    const auto hatched = read_dxf(dxf_entities().square({0, 0}, 60).group(0, "HATCH").group(0, "TEXT"));
    REQUIRE(hatched.warnings.size() == 1);
    CHECK(hatched.warnings[0].message.starts_with("1 HATCH entity is left out"));
    auto hidden = DxfText().section("TABLES").group(0, "LAYER").group(2, "Notes").group(62, "-7").end();
    const auto shown = read_dxf(hidden.section("ENTITIES").square({0, 0}, 60).square({10, 10}, 10, "NOTES"));
    CHECK(area_of_dxf(shown) == 3600);
    CHECK(shown.warnings.at(0).message.starts_with("4 entities are left out"));
}

TEST_CASE("an outline of a DXF with a gap is refused, so that its hole is not taken for it", "[io]") {
    auto gap = dxf_entities();
    gap.line({0, 0}, {60, 0}).line({60, 0.05}, {60, 60}).line({60, 60}, {0, 60}).line({0, 60}, {0, 0});
    CHECK(refusal_of_dxf(gap.circle({30, 30}, 5)) ==
          "malformed [E-FOOTPRINT] plate.dxf: an outline has a gap of 0.05 between (60, 0) and (60, 0.05); 4 "
          "LINE entities are open | join the ends in the CAD program, or delete the lines if they do not "
          "belong to an outline");
    auto side = dxf_entities(); // a whole side is missing
    side.line({0, 0}, {60, 0}).line({60, 60}, {0, 60}).line({0, 60}, {0, 0}).circle({30, 30}, 5);
    CHECK(refusal_of_dxf(side).starts_with("malformed [E-FOOTPRINT] plate.dxf: an outline has a gap of 60"));
    CHECK(refusal_of_dxf(dxf_entities().square({0, 0}, 60).line({0, 0}, {60, 60}))
              .find("lines branch at (0, 0)") != std::string::npos);
    const std::string part = "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n10\n0\n20\n0\n40\n1\n";
    io::Bytes bytes(part.size());
    std::memcpy(bytes.data(), part.data(), part.size());
    CHECK(test::failure([&] {
              static_cast<void>(io::read_footprint(io::Input::of("half.dxf", std::move(bytes))));
          }) == "malformed [E-DXF] half.dxf:13: the file ends within the list of entities");
}

TEST_CASE("copies of lines of a DXF count once, and rings may touch", "[io]") {
    auto twice = dxf_entities().square({0, 0}, 60).square({0, 0}, 60).circle({30, 30}, 5).circle({30, 30}, 5);
    CHECK(area_of_dxf(read_dxf(twice)) == Approx(3600 - circle_area(5)));
    CHECK(area_of_dxf(read_dxf(dxf_entities().square({0, 0}, 10).square({10, 10}, 20))) == 500);
    auto bow = dxf_entities(); // two triangles whose tips meet
    bow.line({0, 0}, {10, 10}).line({10, 10}, {20, 20}).line({20, 20}, {20, 0});
    bow.line({20, 0}, {10, 10}).line({10, 10}, {0, 20}).line({0, 20}, {0, 0});
    CHECK(area_of_dxf(read_dxf(bow)) == 200);
    auto midpoints = dxf_entities(); // a square in a square: four lines meet at the middle of each side
    const Vec2 p[] = {{0, 0}, {10, 0}, {20, 0}, {20, 10}, {20, 20}, {10, 20}, {0, 20}, {0, 10}};
    for (int i = 0; i < 8; ++i) midpoints.line(p[i], p[(i + 1) % 8]);
    for (int i = 1; i < 8; i += 2) midpoints.line(p[i], p[(i + 2) % 8]);
    CHECK(area_of_dxf(read_dxf(midpoints)) == 200);
    // A leader from a corner belongs to another layer than the outline.
    CHECK(area_of_dxf(read_dxf(dxf_entities().square({0, 0}, 60, "A").line({0, 0}, {60, 60}, "B"))) == 3600);
}

TEST_CASE("a DXF states its unit", "[io]") {
    auto drawing = DxfText().section("HEADER").group(9, "$INSUNITS").group(70, "1").end();
    const auto file = read_dxf(drawing.section("ENTITIES").square({1, 1}, 2));
    CHECK(file.metres == 0.0254);
    CHECK(file.can_state_unit);
    CHECK(read_dxf(dxf_entities().square({1, 1}, 2)).metres == 0);
}
