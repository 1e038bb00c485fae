#include "report/simplify_json.hpp"

#include <fmt/format.h>

namespace facetmill::report {

namespace {

using Stop = SimplifyResult::Stop;

const char* spelled(Stop stop) {
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

const char* spelled(NormalSeams::Shading shading) {
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
        {"normals", spelled(r.shading)},
        {"merged_wedges", r.merged_wedges},
        {"triangles_before", r.faces_before},
        {"triangles_after", r.faces_after},
        {"vertices_before", r.vertices_before},
        {"vertices_after", r.vertices_after},
        {"ratio", r.faces_before > 0 ? Json(double(r.faces_after) / double(r.faces_before)) : Json()},
        {"stopped_by", spelled(r.stop)},
        {"largest_error", scaled(r.largest_error, scale)},
        {"collapses", r.collapses},
        {"blocked_edges",
         {{"borders", r.blocked.borders},
          {"topology", r.blocked.topology},
          {"flips", r.blocked.flips},
          {"error", r.blocked.error}}}};
    if (r.cell) entry["cell"] = scaled(r.cell, scale);
    if (r.measured) entry["rolled_back"] = r.rolled_back, entry["measurements"] = r.measurements;
    if (r.intersections_after)
        entry["self_intersections"] = {{"before", *r.intersections_before},
                                       {"after", *r.intersections_after},
                                       {"held_vertices", r.held}};
    return entry;
}

Json topology_change_json(const Properties& before, const Properties& after) {
    return {{"before", topology_json(before)}, {"after", topology_json(after)}};
}

std::string held_by(const SimplifyResult& r) {
    const auto& b = r.blocked;
    if (r.cell) return "with larger cells no face would be left";
    if (b.borders + b.topology + b.flips == 0) return "no collapse was left within the constraints";
    return fmt::format(
        "of the edges left, {} are held by borders and locks, {} by topology, {} would flip a face",
        b.borders, b.topology, b.flips);
}

} // namespace facetmill::report
