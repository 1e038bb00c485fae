#include "stages/clean/report.hpp"

#include <algorithm>

namespace facetmill {

namespace {

void declare_not_done(DeclareFields<NotDone>& d) {
    d.field("step", &NotDone::step, "The option that asked for it.");
    d.field("why", &NotDone::why, "What was in the way.");
    d.field("at", &NotDone::at, "Where, in the world.");
}

void declare_part(DeclareFields<CleanedPart>& d) {
    d.field("part", &CleanedPart::part, "Its name.");
    d.field(
        "changed", [](const CleanedPart& p) { return p.counts.total() > 0; }, "Whether anything was done.");
    const auto count = [&](const char* name, std::size_t CleanCounts::*member, const char* help) {
        d.field(
            name, [member](const CleanedPart& p) { return p.counts.*member; }, help);
    };
    using C = CleanCounts;
    count("welded_vertices", &C::welded_vertices, "Vertices that became one with others.");
    count("degenerate_faces", &C::degenerate_faces, "Faces without area that were removed.");
    count("repeated_corners", &C::repeated_corners, "Corners that repeated the one before.");
    count("duplicate_faces", &C::duplicate_faces, "Faces that were there more than once.");
    count("t_vertices", &C::t_vertices, "Vertices that were put on open edges.");
    count("stitched_edges", &C::stitched_edges, "Pairs of open edges that were joined.");
    count("split_vertices", &C::split_vertices, "Vertices of several fans that were taken apart.");
    count("split_edges", &C::split_edges, "Edges of more than two faces that were taken apart.");
    count("filled_holes", &C::filled_holes, "Holes that were filled.");
    count("hole_faces", &C::hole_faces, "Faces that fill them.");
    count("removed_components", &C::components, "Small pieces that were removed.");
    count("component_faces", &C::component_faces, "Faces of those.");
    count("removed_shells", &C::shells, "Pieces inside others that were removed.");
    count("shell_faces", &C::shell_faces, "Faces of those.");
    count("isolated_vertices", &C::isolated_vertices, "Vertices without faces that were removed.");
    count("united_pieces", &C::united_pieces, "Closed pieces that intersected and are part of a union now.");
    count("refined_faces", &C::refined_faces, "Faces cut where they intersected, once in each repetition.");
    count("covered_faces", &C::covered_faces, "Faces that intersected nothing and lay inside another piece.");
    count("touching_edges", &C::touching_edges,
          "Edges of more than two faces that unions made, where solids touch.");
    count("intersecting_faces", &C::intersecting_faces, "Faces that intersected and were replaced.");
    d.list("not_done", &CleanedPart::not_done, "The first ten repairs that were not done.", declare_not_done);
}

} // namespace

void declare_clean_report(DeclareFields<CleanReport>& d) {
    d.list("parts", &CleanReport::parts, "Each part that was cleaned.", declare_part)
        .tallied("nothing to mend");
}

std::vector<NotDone> first_not_done(const std::vector<NotDone>& all, const Transform& to_world) {
    constexpr std::size_t most = 10;
    std::vector<NotDone> first(all.begin(),
                               all.begin() + static_cast<std::ptrdiff_t>(std::min(most, all.size())));
    for (NotDone& one : first) one.at = to_world.point(one.at);
    return first;
}

} // namespace facetmill
