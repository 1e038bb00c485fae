#include "io/drawing/drawing.hpp"

#include "base/math/numbers.hpp"
#include "base/text/markup.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

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

/// The bounds on the paper, not empty.
Box bounds_of(const Paper& paper) {
    Box box = paper.bounds();
    if (!box.empty()) return box;
    box.add(Vec3{});
    box.add(Vec3{1, 1, 0});
    return box;
}

/// Sizes of texts and ticks, as multiples of the width of lines.
constexpr double text_size = 16, tick_size = 6;

/// Writes the sheets of a drawing. Coordinates are relative to the lower left corner of all sheets.
class SvgSheets {
  public:
    SvgSheets(const Drawing& drawing, const Paper& paper, double stroke)
        : drawing_(drawing), paper_(paper), corner_{bounds_of(paper).min.x, bounds_of(paper).min.y},
          stroke_(stroke) {}

    void draw(std::string& out, const Sheet& sheet) const {
        for (const auto& part : sheet.parts) draw(out, sheet, part);
        if (drawing_.layout.kind == DrawingLayout::Kind::contours) label(out, sheet);
    }

    /// The ticks of a profile, about eight on the longer side.
    void draw_ticks(std::string& out) const {
        const Box box = bounds_of(paper_);
        const Vec3 size = box.extent();
        const double exaggeration = drawing_.layout.exaggeration;
        const double along = step_of(std::max(size.x, size.y)), up = step_of(size.y / exaggeration);
        out += "<g class=\"ticks\">\n";
        constexpr int most = 64; // numbers beyond 2^53 have no next number
        for (int n = 0; n < most && n * along <= size.x; ++n)
            tick(out, {n * along, 0}, {0, -tick_size}, n * along);
        const double first = std::ceil(box.min.y / exaggeration / up);
        for (int n = 0; n < most && (first + n) * up * exaggeration <= box.max.y; ++n)
            tick(out, {0, (first + n) * up * exaggeration - corner_.y}, {-tick_size, 0}, (first + n) * up);
        out += "</g>\n";
    }

  private:
    /// 1, 2 or 5 times a power of ten, so that it divides the size into about eight.
    static double step_of(double size) {
        if (!(size > 0) || !std::isfinite(size)) return 1;
        double step = 1;
        while (step * 8 < size) step *= 10;
        while (step * 8 > size * 10) step /= 10;
        for (const double less : {0.2, 0.5})
            if (step * less * 8 >= size) return step * less;
        return step;
    }

    std::string text_of(const Vec2& p) const {
        return to_string(p.x - corner_.x) + ' ' + to_string(p.y - corner_.y);
    }
    void path(std::string& out, const std::vector<Vec2>& points, bool closed) const {
        const char* command = "M";
        for (const Vec2& p : points) {
            out += command + text_of(p);
            command = "L";
        }
        if (closed) out += 'Z';
    }
    void write_path(std::string& out, const char* kind, const std::string& d) const {
        if (!d.empty()) out += fmt::format("<path class=\"{}\" d=\"{}\"/>\n", kind, d);
    }

    void draw(std::string& out, const Sheet& sheet, const DrawnPart& part) const {
        const Section& s = part.section;
        std::string filled, open, lines, hatch;
        if (drawing_.layout.is_of_lines()) {
            for (const Contour& c : s.contours)
                path(lines, paper_.at(sheet, s.ring(c)), c.role != ContourRole::open);
        } else {
            for (const auto& ring : s.filled()) path(filled, paper_.at(sheet, ring), true);
            for (const Contour& c : s.contours) {
                if (c.role == ContourRole::open) path(open, paper_.at(sheet, s.ring(c)), false);
                if (c.role == ContourRole::inner) path(open, paper_.at(sheet, s.ring(c)), true);
            }
        }
        for (const auto& h : part.hatch)
            hatch += "M" + text_of(paper_.at(sheet, h.a)) + "L" + text_of(paper_.at(sheet, h.b));
        out += "<g><title>" + escaped(part.name) + "</title>\n";
        write_path(out, "cut", filled);
        write_path(out, "open", open);
        write_path(out, "line", lines);
        write_path(out, "hatch", hatch);
        out += "</g>\n";
    }

    /// Writes the elevation at the middle of the longest contour.
    void label(std::string& out, const Sheet& sheet) const {
        const Section* section = nullptr;
        const Contour* longest = nullptr;
        for (const auto& part : sheet.parts)
            for (const Contour& c : part.section.contours)
                if (!longest || c.length > longest->length) {
                    longest = &c;
                    section = &part.section;
                }
        if (!longest) return;
        const polygon::Ring ring = section->ring(*longest);
        const Vec2 at = paper_.at(sheet, ring[ring.size() / 2]);
        text(out, at - corner_, paper_.elevation(sheet).value_or(sheet.height));
    }

    void tick(std::string& out, const Vec2& from, const Vec2& by, double value) const {
        const Vec2 to = from + by * stroke_;
        out += fmt::format("<path class=\"line\" d=\"M{} {}L{} {}\"/>\n", to_string(from.x),
                           to_string(from.y), to_string(to.x), to_string(to.y));
        text(out, from + by * ((tick_size + text_size) / tick_size * stroke_), value);
    }
    /// A number, upright although the sheet's y axis points up.
    void text(std::string& out, const Vec2& at, double value) const {
        out += fmt::format("<text transform=\"translate({} {}) scale(1 -1)\">{:.10g}</text>\n",
                           to_string(at.x), to_string(at.y), value);
    }

    const Drawing& drawing_;
    const Paper& paper_;
    Vec2 corner_;
    double stroke_;
};

/// The cells of the sheets, in rows. Layouts of lines have a single cell.
struct SvgCells {
    double x = 0, y = 0, margin = 0;
    std::size_t columns = 1, rows = 1;

    SvgCells(const Box& box, std::size_t count) {
        margin = 0.05 * std::max(box.extent().x, box.extent().y);
        x = box.extent().x + 2 * margin;
        y = box.extent().y + 2 * margin;
        while (static_cast<double>(columns * columns) * x < static_cast<double>(count) * y) ++columns;
        columns = std::min(columns, count);
        rows = (count + columns - 1) / columns;
    }
    double width() const { return x * static_cast<double>(columns); }
    double height() const { return y * static_cast<double>(rows); }
};

std::string svg_head(const Drawing& drawing, const SvgCells& cells, double stroke) {
    const Scale scale = scale_of(drawing.unit);
    const auto size = [&](double length) {
        return to_string(length * scale.factor / drawing.layout.scale) + scale.unit;
    };
    const std::string unit =
        drawing.unit == Unit::unknown ? "scene unit, shown as 1 mm" : to_string(drawing.unit);
    const std::string ratio =
        drawing.layout.scale == 1 ? "" : ", printed at 1:" + to_string(drawing.layout.scale);
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
           size(cells.width()) + "\" height=\"" + size(cells.height()) + "\" viewBox=\"0 0 " +
           to_string(cells.width()) + ' ' + to_string(cells.height()) + "\">\n<title>" +
           escaped(drawing.title) + "</title>\n<desc>1 user unit is 1 " + unit + ratio +
           "</desc>\n<style>path{stroke-linejoin:round;stroke-width:" + to_string(stroke) +
           "}.cut{fill:#dbe4ee;fill-rule:nonzero;stroke:#1b2733}.open{fill:none;stroke:#c0392b}"
           ".line{fill:none;stroke:#1b2733}text{font:" +
           to_string(text_size * stroke) +
           "px sans-serif;fill:#1b2733;text-anchor:middle}.hatch{fill:none;stroke:#5b7083;stroke-width:" +
           to_string(stroke / 2) + "}</style>\n";
}

} // namespace

std::string to_svg(const Drawing& drawing) {
    const Paper paper(drawing);
    const bool lines = drawing.layout.is_of_lines();
    const Box box = bounds_of(paper);
    const SvgCells cells(box, lines ? 1 : std::max<std::size_t>(1, drawing.sheets.size()));
    const double stroke = std::max(cells.x, cells.y) / (lines ? 1000 : 500);
    std::string out = svg_head(drawing, cells, stroke);
    const SvgSheets sheets(drawing, paper, stroke);
    for (std::size_t i = 0; i < drawing.sheets.size(); ++i) {
        const Sheet& sheet = drawing.sheets[i];
        const std::size_t cell = lines ? 0 : i;
        const double x = cells.x * static_cast<double>(cell % cells.columns) + cells.margin;
        const double y = cells.y * static_cast<double>(cell / cells.columns) + cells.margin + box.extent().y;
        out += "<g id=\"section-" + std::to_string(i + 1) + "\" data-height=\"" + to_string(sheet.height);
        if (const auto elevation = paper.elevation(sheet))
            out += "\" data-elevation=\"" + to_string(*elevation);
        out += "\" transform=\"translate(" + to_string(x) + ' ' + to_string(y) + ") scale(1 -1)\">\n";
        sheets.draw(out, sheet);
        if (i == 0 && drawing.layout.kind == DrawingLayout::Kind::profile) sheets.draw_ticks(out);
        out += "</g>\n";
    }
    return out + "</svg>\n";
}

} // namespace facetmill::io
