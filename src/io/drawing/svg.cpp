#include "io/drawing/drawing.hpp"

#include "base/math/numbers.hpp"
#include "base/text/markup.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill::io {

namespace {

/// The SVG unit, and the number of SVG units per scene unit.
struct Scale {
    const char* unit;
    double factor;
};

Scale scale_of(Unit unit) {
    switch (unit) {
    case Unit::mm:
        return {"mm", 1};
    case Unit::cm:
        return {"cm", 1};
    case Unit::inch:
        return {"in", 1};
    case Unit::unknown:
        return {"mm", 1}; // a drawing needs a size, so an unknown unit is drawn as a millimetre
    case Unit::um:
    case Unit::m:
    case Unit::km:
    case Unit::foot:
        break;
    }
    return {"mm", metres(unit) * 1000};
}

Box bounds_of(const Drawing& drawing) {
    Box box;
    for (const auto& sheet : drawing.sheets)
        for (const auto& part : sheet.parts) {
            for (const Vec2& p : part.section.points) box.add(Vec3{p.x, p.y, 0});
            for (const auto& s : part.hatch) {
                box.add(Vec3{s.a.x, s.a.y, 0});
                box.add(Vec3{s.b.x, s.b.y, 0});
            }
        }
    if (box.empty()) {
        box.add(Vec3{});
        box.add(Vec3{1, 1, 0});
    }
    return box;
}

void path(std::string& out, polygon::Ring ring, bool closed) {
    const char* command = "M";
    for (const Vec2& p : ring) {
        out += command + to_string(p.x) + ' ' + to_string(p.y);
        command = "L";
    }
    if (closed) out += 'Z';
}

void draw(std::string& out, const DrawnPart& part) {
    const Section& s = part.section;
    std::string filled, open;
    for (const auto& ring : s.filled()) path(filled, ring, true);
    for (const Contour& c : s.contours) {
        if (c.role == ContourRole::open) path(open, s.ring(c), false);
        if (c.role == ContourRole::inner) path(open, s.ring(c), true);
    }
    out += "<g><title>" + escaped(part.name) + "</title>\n";
    if (!filled.empty()) out += "<path class=\"cut\" d=\"" + filled + "\"/>\n";
    if (!open.empty()) out += "<path class=\"open\" d=\"" + open + "\"/>\n";
    if (!part.hatch.empty()) {
        out += "<path class=\"hatch\" d=\"";
        for (const auto& h : part.hatch)
            out += "M" + to_string(h.a.x) + ' ' + to_string(h.a.y) + "L" + to_string(h.b.x) + ' ' +
                   to_string(h.b.y);
        out += "\"/>\n";
    }
    out += "</g>\n";
}

} // namespace

std::string to_svg(const Drawing& drawing) {
    const Scale scale = scale_of(drawing.unit);
    const Box box = bounds_of(drawing);
    const double wide = box.extent().x, high = box.extent().y, margin = 0.05 * std::max(wide, high);
    const double cell_x = wide + 2 * margin, cell_y = high + 2 * margin;
    const std::size_t count = std::max<std::size_t>(1, drawing.sheets.size());
    std::size_t columns = 1;
    while (static_cast<double>(columns * columns) * cell_x < static_cast<double>(count) * cell_y) ++columns;
    columns = std::min(columns, count);
    const std::size_t rows = (count + columns - 1) / columns;
    const double width = cell_x * static_cast<double>(columns), height = cell_y * static_cast<double>(rows);
    const double stroke = std::max(cell_x, cell_y) / 500;
    std::string out =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
        to_string(width * scale.factor) + scale.unit + "\" height=\"" + to_string(height * scale.factor) +
        scale.unit + "\" viewBox=\"0 0 " + to_string(width) + ' ' + to_string(height) + "\">\n<title>" +
        escaped(drawing.title) + "</title>\n<desc>1 user unit is 1 " +
        (drawing.unit == Unit::unknown ? "scene unit, shown as 1 mm" : to_string(drawing.unit)) +
        "</desc>\n<style>path{stroke-linejoin:round;stroke-width:" + to_string(stroke) +
        "}.cut{fill:#dbe4ee;fill-rule:nonzero;stroke:#1b2733}.open{fill:none;stroke:#c0392b}"
        ".hatch{fill:none;stroke:#5b7083;stroke-width:" +
        to_string(stroke / 2) + "}</style>\n";
    for (std::size_t i = 0; i < drawing.sheets.size(); ++i) {
        const Sheet& sheet = drawing.sheets[i];
        const double x = cell_x * static_cast<double>(i % columns) + margin - box.min.x;
        const double y = cell_y * static_cast<double>(i / columns) + margin + box.max.y;
        out += "<g id=\"section-" + std::to_string(i + 1) + "\" data-height=\"" + to_string(sheet.height) +
               "\" transform=\"translate(" + to_string(x) + ' ' + to_string(y) + ") scale(1 -1)\">\n";
        for (const auto& part : sheet.parts) draw(out, part);
        out += "</g>\n";
    }
    return out + "</svg>\n";
}

} // namespace facetmill::io
