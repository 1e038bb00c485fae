#include "io/drawing/summary.hpp"

namespace facetmill::io {

namespace {

constexpr std::size_t most_listed = 200;

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
        if (listed > most_listed || count == 0) continue;
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
