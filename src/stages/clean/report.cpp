#include "stages/clean/report.hpp"

#include "base/point_json.hpp"

#include <algorithm>

namespace facetmill::report {

Json counts_json(const CleanCounts& n) {
    return {{"welded_vertices", n.welded_vertices},
            {"degenerate_faces", n.degenerate_faces},
            {"repeated_corners", n.repeated_corners},
            {"duplicate_faces", n.duplicate_faces},
            {"t_vertices", n.t_vertices},
            {"stitched_edges", n.stitched_edges},
            {"split_vertices", n.split_vertices},
            {"split_edges", n.split_edges},
            {"filled_holes", n.filled_holes},
            {"hole_faces", n.hole_faces},
            {"removed_components", n.components},
            {"component_faces", n.component_faces},
            {"removed_shells", n.shells},
            {"shell_faces", n.shell_faces},
            {"isolated_vertices", n.isolated_vertices},
            {"united_pieces", n.united_pieces},
            {"refined_faces", n.refined_faces},
            {"covered_faces", n.covered_faces},
            {"touching_edges", n.touching_edges},
            {"intersecting_faces", n.intersecting_faces}};
}

Json not_done_json(const std::vector<NotDone>& all, const Transform& to_world) {
    constexpr std::size_t most = 10;
    Json list = Json::array();
    for (std::size_t i = 0; i < std::min(most, all.size()); ++i)
        list.push_back(
            {{"step", all[i].step}, {"why", all[i].why}, {"at", point_json(to_world.point(all[i].at))}});
    return list;
}

} // namespace facetmill::report
