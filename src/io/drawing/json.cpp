#include "base/error.hpp"
#include "base/point_json.hpp"
#include "io/drawing/drawing.hpp"

#include <fmt/format.h>

namespace facetmill::io {

namespace {

Json list(const Vec2& p) { return Json::array({p.x, p.y}); }
Json list(const Vec3& p) { return point_json(p); }

/// In the plane as the note has them; in the world the integrals of products of coordinates, about the
/// world's origin for a centroid that is not 0.
Json second_moments(const polygon::SecondMoments& plane, const Section& s, const polygon::Moments& m,
                    const Vec3& centroid) {
    const Vec3 &u = s.frame.u, &v = s.frame.v;
    const auto product = [&](std::size_t i, std::size_t j) {
        return u[i] * u[j] * m.about_centroid.y + v[i] * v[j] * m.about_centroid.x +
               (u[i] * v[j] + v[i] * u[j]) * m.about_centroid.xy + m.area * centroid[i] * centroid[j];
    };
    const Json world = {{"xx", product(0, 0)}, {"yy", product(1, 1)}, {"zz", product(2, 2)},
                        {"xy", product(0, 1)}, {"xz", product(0, 2)}, {"yz", product(1, 2)}};
    return {{"x", plane.x}, {"y", plane.y}, {"xy", plane.xy}, {"world", world}};
}

/// Centroid, second moments and principal axes, put into j.
void add_moments(Json& j, const Section& s, const polygon::Moments& m) {
    const Vec3 centroid = s.frame.point(m.centroid);
    j["centroid"] = {{"plane", list(m.centroid)}, {"world", list(centroid)}};
    j["second_moments"] = {{"about_origin", second_moments(m.about_origin, s, m, centroid)},
                           {"about_centroid", second_moments(m.about_centroid, s, m, {})}};
    j["principal_axes"] = {{"largest", m.axes.largest},
                           {"smallest", m.axes.smallest},
                           {"plane", {{"largest", list(m.axes.major)}, {"smallest", list(m.axes.minor)}}},
                           {"world",
                            {{"largest", list(s.frame.direction(m.axes.major))},
                             {"smallest", list(s.frame.direction(m.axes.minor))}}}};
}

Json contour_json(const Section& s, const Contour& c) {
    Json j = {{"role", to_string(c.role)}};
    if (c.parent != none) j["parent"] = c.parent;
    j["points"] = c.end - c.begin;
    j["length"] = c.length;
    if (c.role == ContourRole::open) return j;
    j["orientation"] = c.orientation > 0 ? "anticlockwise" : "clockwise";
    j["kind"] = polygon::to_string(c.kind);
    j["area"] = c.area;
    if (!c.moments) {
        j["centroid"] = nullptr;
        j["why"] = "the contour intersects itself, so its centroid and moments would mean nothing";
        return j;
    }
    add_moments(j, s, *c.moments);
    return j;
}

std::string extension_of(const std::string& path) {
    const auto dot = path.rfind('.');
    std::string extension = dot == std::string::npos ? "" : path.substr(dot + 1);
    for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return extension;
}

} // namespace

Json frame_json(const SectionFrame& f) {
    return {{"origin", list(f.origin)}, {"u", list(f.u)}, {"v", list(f.v)}, {"normal", list(f.normal)}};
}

Json section_json(const Section& section, bool points) {
    Json j = {{"area", section.area}};
    if (section.moments)
        add_moments(j, section, *section.moments);
    else
        j["centroid"] = nullptr;
    j["contours"] = contours_json(section, points);
    return j;
}

Json contours_json(const Section& section, bool points) {
    Json all = Json::array();
    for (const Contour& c : section.contours) {
        Json j = contour_json(section, c);
        if (points) {
            Json list_of = Json::array();
            for (const Vec2& p : section.ring(c)) list_of.push_back(list(p));
            j["points"] = std::move(list_of);
        }
        all.push_back(std::move(j));
    }
    return all;
}

std::string to_json(const Drawing& drawing) {
    Json sheets = Json::array();
    for (const Sheet& sheet : drawing.sheets) {
        Json parts = Json::array();
        for (const DrawnPart& part : sheet.parts) {
            Json hatch = Json::array();
            for (const auto& s : part.hatch) hatch.push_back(Json::array({s.a.x, s.a.y, s.b.x, s.b.y}));
            Json j = section_json(part.section, true);
            j["name"] = part.name;
            j["hatch"] = std::move(hatch);
            parts.push_back(std::move(j));
        }
        sheets.push_back(
            {{"height", sheet.height}, {"frame", frame_json(sheet.frame)}, {"parts", std::move(parts)}});
    }
    const Json document = {
        {"title", drawing.title}, {"unit", to_string(drawing.unit)}, {"sections", std::move(sheets)}};
    return document.dump(1) + "\n";
}

bool is_drawing(const std::string& path) {
    const std::string e = extension_of(path);
    return e == "svg" || e == "dxf" || e == "json";
}

std::string drawing_for(const std::string& path, const Drawing& drawing) {
    const std::string e = extension_of(path);
    if (e == "svg") return to_svg(drawing);
    if (e == "dxf") return to_dxf(drawing);
    if (e == "json") return to_json(drawing);
    throw Error(ErrorKind::usage, "E-DRAWING", fmt::format("sections are not written as '{}'", path),
                "the formats are .svg, .dxf and .json");
}

// --- summary

namespace {

constexpr std::size_t max_listed = 200;

void add(DrawingTotals& totals, const Section& s) {
    totals.area += s.area;
    totals.touched += s.collapsed;
    totals.oriented = totals.oriented && s.oriented;
    totals.contours += s.contours.size();
    for (const Contour& c : s.contours) {
        totals.holes += c.role == ContourRole::hole;
        totals.open += c.role == ContourRole::open;
        if (c.role != ContourRole::open) ++totals.kinds[static_cast<std::size_t>(c.kind)];
    }
}

Json sheet_json(const Sheet& sheet, std::size_t& listed) {
    Json parts = Json::array();
    double area = 0;
    std::size_t contours = 0;
    for (const auto& part : sheet.parts) {
        const std::size_t count = part.section.contours.size();
        area += part.section.area;
        contours += count;
        listed += count;
        if (listed > max_listed || count == 0) continue;
        parts.push_back(section_json(part.section, false));
        parts.back()["part"] = part.name;
    }
    const Vec3& origin = sheet.frame.origin;
    Json j = {{"height", sheet.height},
              {"origin", {origin.x, origin.y, origin.z}},
              {"area", area},
              {"contours", contours}};
    if (!parts.empty()) j["parts"] = std::move(parts);
    return j;
}

} // namespace

DrawingTotals totals_of(const Drawing& drawing) {
    DrawingTotals totals;
    for (const auto& sheet : drawing.sheets) {
        const std::size_t before = totals.contours;
        for (const auto& part : sheet.parts) add(totals, part.section);
        totals.empty += totals.contours == before;
    }
    return totals;
}

Json summary_json(const Drawing& drawing, const DrawingTotals& totals) {
    Json j = Json::object();
    j["planes"] = drawing.sheets.size();
    j["empty"] = totals.empty;
    j["contours"] = totals.contours;
    j["holes"] = totals.holes;
    j["open"] = totals.open;
    j["touched"] = totals.touched;
    for (int k = 0; k < polygon::kinds; ++k)
        j["kinds"][polygon::to_string(static_cast<polygon::Kind>(k))] =
            totals.kinds[static_cast<std::size_t>(k)];
    j["area"] = totals.area;
    if (!drawing.sheets.empty()) j["frame"] = frame_json(drawing.sheets.front().frame);
    std::size_t listed = 0;
    j["sections"] = Json::array();
    for (const auto& sheet : drawing.sheets) j["sections"].push_back(sheet_json(sheet, listed));
    return j;
}

} // namespace facetmill::io
