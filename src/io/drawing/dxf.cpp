#include "io/drawing/drawing.hpp"

#include "base/math/numbers.hpp"

namespace facetmill::io {

namespace {

/// $INSUNITS of the DXF reference: 0 is unitless.
int insunits(Unit unit) {
    switch (unit) {
    case Unit::inch:
        return 1;
    case Unit::foot:
        return 2;
    case Unit::mm:
        return 4;
    case Unit::cm:
        return 5;
    case Unit::m:
        return 6;
    case Unit::km:
        return 7;
    case Unit::um:
        return 13;
    case Unit::unknown:
        break;
    }
    return 0;
}

class Writer {
  public:
    void group(int code, std::string_view value) {
        text += std::to_string(code) + "\n";
        text += value;
        text += '\n';
    }
    void group(int code, double value) { group(code, to_string(value)); }
    void group(int code, std::size_t value) { group(code, std::to_string(value)); }
    void point(int code, const Vec2& p, double z) {
        group(code, p.x);
        group(code + 10, p.y);
        group(code + 20, z);
    }
    void start(std::string_view type, const std::string& layer) {
        group(0, type);
        group(8, layer);
    }
    std::string text;
};

void layers(Writer& w, std::size_t sheets) {
    w.group(0, "SECTION");
    w.group(2, "TABLES");
    w.group(0, "TABLE");
    w.group(2, "LAYER");
    w.group(70, 2 * sheets);
    for (std::size_t i = 1; i <= sheets; ++i)
        for (const auto& [name, colour] :
             {std::pair{"SECTION_", std::size_t{7}}, std::pair{"HATCH_", std::size_t{8}}}) {
            w.group(0, "LAYER");
            w.group(2, name + std::to_string(i));
            w.group(70, std::size_t{0});
            w.group(62, colour);
            w.group(6, "CONTINUOUS");
        }
    w.group(0, "ENDTAB");
    w.group(0, "ENDSEC");
}

void polyline(Writer& w, polygon::Ring ring, bool closed, const std::string& layer, double z) {
    w.start("POLYLINE", layer);
    w.group(66, std::size_t{1});
    w.point(10, {0, 0}, z);
    w.group(70, std::size_t{closed});
    for (const Vec2& p : ring) {
        w.start("VERTEX", layer);
        w.point(10, p, z);
    }
    w.start("SEQEND", layer);
}

} // namespace

std::string to_dxf(const Drawing& drawing) {
    Writer w;
    w.group(999, "sections by facetmill, in the frame of their plane; unit: " +
                     std::string(to_string(drawing.unit)));
    w.group(0, "SECTION");
    w.group(2, "HEADER");
    w.group(9, "$ACADVER");
    w.group(1, "AC1009");
    w.group(9, "$INSUNITS");
    w.group(70, static_cast<std::size_t>(insunits(drawing.unit)));
    w.group(0, "ENDSEC");
    layers(w, drawing.sheets.size());
    w.group(0, "SECTION");
    w.group(2, "ENTITIES");
    for (std::size_t i = 0; i < drawing.sheets.size(); ++i) {
        const Sheet& sheet = drawing.sheets[i];
        const double z = dot(sheet.frame.origin, sheet.frame.normal);
        for (const auto& part : sheet.parts) {
            for (const Contour& c : part.section.contours)
                polyline(w, part.section.ring(c), c.role != ContourRole::open,
                         "SECTION_" + std::to_string(i + 1), z);
            for (const auto& h : part.hatch) {
                w.start("LINE", "HATCH_" + std::to_string(i + 1));
                w.point(10, h.a, z);
                w.point(11, h.b, z);
            }
        }
    }
    w.group(0, "ENDSEC");
    w.group(0, "EOF");
    return std::move(w.text);
}

} // namespace facetmill::io
