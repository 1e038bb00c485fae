#include "io/drawing/drawing.hpp"

#include "base/math/numbers.hpp"

#include <algorithm>
#include <fmt/format.h>

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

/// The layer of a sheet. Names in release 12 have letters, digits, $, - and _, and at most 31 of them.
std::string layer_of(const Drawing& drawing, const Paper& paper, std::size_t i) {
    const auto elevation = paper.elevation(drawing.sheets[i]);
    if (drawing.layout.kind != DrawingLayout::Kind::contours || !elevation)
        return "SECTION_" + std::to_string(i + 1);
    std::string name = fmt::format("CONTOUR_{:.10g}", *elevation);
    std::replace(name.begin(), name.end(), '.', '_');
    std::erase(name, '+');
    return name;
}

void layers(Writer& w, const std::vector<std::string>& names) {
    w.group(0, "SECTION");
    w.group(2, "TABLES");
    w.group(0, "TABLE");
    w.group(2, "LAYER");
    w.group(70, 2 * names.size());
    for (std::size_t i = 0; i < names.size(); ++i)
        for (const auto& [name, colour] : {std::pair{names[i], std::size_t{7}},
                                           std::pair{"HATCH_" + std::to_string(i + 1), std::size_t{8}}}) {
            w.group(0, "LAYER");
            w.group(2, name);
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

/// The elevation of the entities of a sheet.
double elevation_of(const Drawing& drawing, const Paper& paper, const Sheet& sheet) {
    const double above = dot(sheet.frame.origin, sheet.frame.normal);
    if (drawing.layout.kind == DrawingLayout::Kind::profile) return 0;
    return drawing.layout.kind == DrawingLayout::Kind::contours ? paper.elevation(sheet).value_or(above)
                                                                : above;
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
    const Paper paper(drawing);
    std::vector<std::string> names;
    names.reserve(drawing.sheets.size());
    for (std::size_t i = 0; i < drawing.sheets.size(); ++i) names.push_back(layer_of(drawing, paper, i));
    layers(w, names);
    w.group(0, "SECTION");
    w.group(2, "ENTITIES");
    for (std::size_t i = 0; i < drawing.sheets.size(); ++i) {
        const Sheet& sheet = drawing.sheets[i];
        const double z = elevation_of(drawing, paper, sheet);
        for (const auto& part : sheet.parts) {
            for (const Contour& c : part.section.contours)
                polyline(w, paper.at(sheet, part.section.ring(c)), c.role != ContourRole::open, names[i], z);
            for (const auto& h : part.hatch) {
                w.start("LINE", "HATCH_" + std::to_string(i + 1));
                w.point(10, paper.at(sheet, h.a), z);
                w.point(11, paper.at(sheet, h.b), z);
            }
        }
    }
    w.group(0, "ENDSEC");
    w.group(0, "EOF");
    return std::move(w.text);
}

} // namespace facetmill::io
