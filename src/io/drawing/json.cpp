#include "base/error.hpp"
#include "base/text/spelling.hpp"
#include "io/drawing/drawing.hpp"
#include "io/drawing/drawing_fields.hpp"

#include <fmt/format.h>

namespace facetmill::io {

namespace {

std::string extension_of(const std::string& path) {
    const auto dot = path.rfind('.');
    return dot == std::string::npos ? "" : lower_case(path.substr(dot + 1));
}

/// The fields of the section, with the contours' points instead of their count.
Json with_points(const Section& section) {
    static const Fields fields = fields_of<Section>(declare_section_fields);
    Json json = fields.json(&section);
    for (std::size_t i = 0; i < section.contours.size(); ++i) {
        Json points = Json::array();
        for (const Vec2& p : section.ring(section.contours[i])) points.push_back(Json::array({p.x, p.y}));
        json["contours"][i]["points"] = std::move(points);
    }
    return json;
}

} // namespace

std::string to_json(const Drawing& drawing) {
    static const Fields frame = fields_of<SectionFrame>(declare_frame_fields);
    Json sheets = Json::array();
    for (const Sheet& sheet : drawing.sheets) {
        Json parts = Json::array();
        for (const DrawnPart& part : sheet.parts) {
            Json hatch = Json::array();
            for (const auto& s : part.hatch) hatch.push_back(Json::array({s.a.x, s.a.y, s.b.x, s.b.y}));
            Json j = with_points(part.section);
            j["name"] = part.name;
            j["hatch"] = std::move(hatch);
            parts.push_back(std::move(j));
        }
        sheets.push_back(
            {{"height", sheet.height}, {"frame", frame.json(&sheet.frame)}, {"parts", std::move(parts)}});
    }
    const Json document = {
        {"title", drawing.title}, {"unit", to_string(drawing.unit)}, {"sections", std::move(sheets)}};
    return document.dump(1) + "\n";
}

std::string to_geojson(const Drawing& drawing) {
    const Paper paper(drawing);
    const std::size_t north = drawing.up == UpAxis::y ? 2 : 1, up = 3 - north;
    Json features = Json::array();
    for (const Sheet& sheet : drawing.sheets)
        for (const DrawnPart& part : sheet.parts)
            for (const Contour& c : part.section.contours) {
                Json line = Json::array();
                const auto add = [&](const Vec2& p) {
                    const Vec3 world = sheet.frame.point(p);
                    line.push_back(Json::array({world.x, world[north], world[up]}));
                };
                const polygon::Ring ring = part.section.ring(c);
                const bool closed = c.role != ContourRole::open;
                for (const Vec2& p : ring) add(p);
                if (closed && !ring.empty()) add(ring.front());
                Json properties = {{"part", part.name}, {"height", sheet.height}, {"closed", closed}};
                if (const auto elevation = paper.elevation(sheet)) properties["elevation"] = *elevation;
                features.push_back(
                    {{"type", "Feature"},
                     {"properties", std::move(properties)},
                     {"geometry", {{"type", "LineString"}, {"coordinates", std::move(line)}}}});
            }
    return Json{{"type", "FeatureCollection"}, {"features", std::move(features)}}.dump(1) + "\n";
}

bool is_drawing(const std::string& path) {
    const std::string e = extension_of(path);
    return e == "svg" || e == "dxf" || e == "geojson" || e == "json";
}

std::string drawing_for(const std::string& path, const Drawing& drawing) {
    const std::string e = extension_of(path);
    if (e == "svg") return to_svg(drawing);
    if (e == "dxf") return to_dxf(drawing);
    if (e == "geojson") return to_geojson(drawing);
    if (e == "json") return to_json(drawing);
    throw Error(ErrorKind::usage, "E-DRAWING", fmt::format("sections are not written as '{}'", path),
                "the formats are .svg, .dxf, .geojson and .json");
}

} // namespace facetmill::io
