#include "stages/simplify/report.hpp"

#include "base/readable_numbers.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

using Stop = SimplifyResult::Stop;

const char* to_string(Stop stop) {
    switch (stop) {
    case Stop::nothing:
        return "nothing to do";
    case Stop::ratio:
        return "ratio";
    case Stop::faces:
        return "faces";
    case Stop::vertices:
        return "vertices";
    case Stop::max_error:
        return "max_error";
    default:
        return "stuck";
    }
}

const char* to_string(NormalSeams::Shading shading) {
    switch (shading) {
    case NormalSeams::Shading::smoothed:
        return "seams merged";
    case NormalSeams::Shading::faceted:
        return "flat shading kept";
    default:
        return "as given";
    }
}

Json scaled(const std::optional<double>& length, double scale) {
    return length ? Json(*length * scale) : Json();
}

Json topology_json(const Properties& p) {
    return {{"components", p.components},
            {"euler", p.euler},
            {"genus", p.genus ? Json(*p.genus) : Json()},
            {"boundary_loops", p.boundary_loops},
            {"closed", p.closed},
            {"edge_manifold", p.edge_manifold},
            {"vertex_manifold", p.vertex_manifold}};
}

} // namespace

Json simplify_json(const SimplifyResult& r, double scale) {
    Json entry = {
        {"normals", to_string(r.shading)},
        {"merged_wedges", r.merged_wedges},
        {"triangles_before", r.faces_before},
        {"triangles_after", r.faces_after},
        {"vertices_before", r.vertices_before},
        {"vertices_after", r.vertices_after},
        {"ratio", r.faces_before > 0 ? Json(double(r.faces_after) / double(r.faces_before)) : Json()},
        {"stopped_by", to_string(r.stop)},
        {"largest_error", scaled(r.largest_error, scale)},
        {"collapses", r.collapses},
        {"blocked_edges",
         {{"borders", r.blocked.borders},
          {"seams", r.blocked.seams},
          {"non_manifold", r.blocked.non_manifold},
          {"topology", r.blocked.topology},
          {"flips", r.blocked.flips},
          {"error", r.blocked.error}}}};
    if (r.cell) entry["cell"] = scaled(r.cell, scale);
    if (r.measured) {
        entry["rolled_back"] = r.rolled_back;
        entry["measurements"] = r.measurements;
    }
    if (r.intersections_after)
        entry["self_intersections"] = {{"before", *r.intersections_before},
                                       {"after", *r.intersections_after},
                                       {"held_vertices", r.held}};
    return entry;
}

Json topology_change_json(const Properties& before, const Properties& after) {
    return {{"before", topology_json(before)}, {"after", topology_json(after)}};
}

namespace {

struct Reason {
    std::size_t edges;
    const char* what;
    const char* way_out;
};

std::vector<Reason> reasons(const SimplifyResult::Blocked& b) {
    return {{b.seams, "held by seams and by borders of materials and groups",
             "texture islands, materials and groups keep their borders: fewer of them allow more collapses"},
            {b.borders, "by boundaries and locks", "ask for more faces, or lock less"},
            {b.non_manifold, "at places that are not manifold", "use clean before simplify to repair them"},
            {b.topology, "by topology", "topology: allow lets small components, holes and handles vanish"},
            {b.flips, "would flip a face", "ask for more faces"}};
}

} // namespace

std::string held_by(const SimplifyResult& r) {
    if (r.cell) return "with larger cells no face would remain";
    std::string text;
    for (const auto& [edges, what, way_out] : reasons(r.blocked))
        if (edges > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", grouped(edges), what);
    return text.empty() ? "no collapse was left within the constraints" : "of the edges left, " + text;
}

std::string way_out(const SimplifyResult& r) {
    const auto all = reasons(r.blocked);
    const auto most = std::max_element(all.begin(), all.end(),
                                       [](const Reason& a, const Reason& b) { return a.edges < b.edges; });
    return r.cell || most->edges == 0 ? "ask for more faces" : most->way_out;
}

namespace {

constexpr std::size_t few = 5; // parts that are told one by one

std::string counts_text(std::uint64_t before, std::uint64_t after) {
    std::string text = fmt::format("{} -> {} triangles", grouped(before), grouped(after));
    if (before > 0) text += fmt::format(" ({:.3g} %)", 100 * double(after) / double(before));
    return text;
}

std::string deviation_text(const Json& d) {
    std::string text = fmt::format("deviation {:.3g} %", d["percent"]["maximum"].get<double>());
    text += fmt::format(" (rms {:.3g} %", d["percent"]["rms"].get<double>());
    if (d["percent"]["bound"].is_number())
        text += fmt::format(", certified {:.3g} %", d["percent"]["bound"].get<double>());
    return text + ") of the diagonal";
}

std::string stop_text(const std::string& stop) {
    if (stop == to_string(Stop::nothing)) return ", nothing to do";
    return stop == to_string(Stop::stuck) ? ", stopped above the target" : ", stopped by " + stop;
}

bool is_measured(const Json& part) {
    if (!part.contains("deviation")) return false;
    const Json& percent = part["deviation"]["percent"];
    return percent["maximum"].is_number() && percent["rms"].is_number();
}

} // namespace

std::vector<std::string> simplify_summary(const Json& result) {
    const Json& parts = result["parts"];
    std::vector<std::string> lines;
    std::uint64_t before = 0, after = 0;
    const Json* worst = nullptr;
    for (const Json& part : parts) {
        before += part["triangles_before"].get<std::uint64_t>();
        after += part["triangles_after"].get<std::uint64_t>();
        if (is_measured(part) && (!worst || part["deviation"]["percent"]["maximum"].get<double>() >
                                                (*worst)["deviation"]["percent"]["maximum"].get<double>()))
            worst = &part;
        if (parts.size() > few) continue;
        std::string line = part["part"].get<std::string>() + ": " +
                           counts_text(part["triangles_before"].get<std::uint64_t>(),
                                       part["triangles_after"].get<std::uint64_t>());
        line += stop_text(part["stopped_by"].get<std::string>());
        if (is_measured(part)) line += "; " + deviation_text(part["deviation"]);
        lines.push_back(std::move(line));
    }
    if (parts.size() <= few) return lines;
    lines.push_back(fmt::format("{} parts: {}", parts.size(), counts_text(before, after)));
    if (worst)
        lines.back() += fmt::format("; largest {} (part {})", deviation_text((*worst)["deviation"]),
                                    (*worst)["part"].get<std::string>());
    return lines;
}

} // namespace facetmill::report
