#include "stages/clean/report.hpp"

#include <algorithm>

namespace facetmill::clean_stage {

namespace {

void declare_not_done(DeclareFields<NotDone>& d) {
    d.field("step", &NotDone::step, "The step that was to do it.");
    d.field("why", &NotDone::why, "Why it was not done.");
    d.field("at", &NotDone::at, "Its position in world space.");
}

void declare_part(DeclareFields<CleanedPart>& d) {
    d.field("part", &CleanedPart::part, "Its name.");
    d.field(
        "changed", [](const CleanedPart& p) { return p.counts.total() + p.scaled > 0; },
        "Whether it was changed.");
    const auto count = [&](const char* name, std::size_t CleanCounts::*member, const char* help) {
        d.field(
            name, [member](const CleanedPart& p) { return p.counts.*member; }, help);
    };
    using C = CleanCounts;
    count("rounded_vertices", &C::rounded_vertices, "Vertices that were moved to coordinates of 32 bits.");
    count("welded_vertices", &C::welded_vertices, "Vertices that were merged with others.");
    count("degenerate_faces", &C::degenerate_faces, "Faces without area that were removed.");
    count("repeated_corners", &C::repeated_corners, "Corners that repeated the one before.");
    count("duplicate_faces", &C::duplicate_faces, "Faces that were there more than once.");
    count("t_junctions", &C::t_junctions, "Vertices that were inserted into boundary edges.");
    count("stitched_edges", &C::stitched_edges, "Pairs of boundary edges that were joined.");
    count("split_vertices", &C::split_vertices, "Vertices of several fans that were separated.");
    count("split_edges", &C::split_edges, "Edges of more than two faces that were separated.");
    count("filled_holes", &C::filled_holes, "Holes that were filled.");
    count("hole_faces", &C::hole_faces, "Faces that fill them.");
    count("removed_open_components", &C::open_components, "Components that stayed open and were removed.");
    count("open_component_faces", &C::open_component_faces, "Faces of those.");
    count("removed_components", &C::components, "Small components that were removed.");
    count("component_faces", &C::component_faces, "Faces of those.");
    count("removed_inner_components", &C::inner_components, "Components inside others that were removed.");
    count("inner_component_faces", &C::inner_component_faces, "Faces of those.");
    count("isolated_vertices", &C::isolated_vertices, "Vertices without faces that were removed.");
    count("united_components", &C::united_components,
          "Closed components that intersected and are part of a union now.");
    count("refined_faces", &C::refined_faces, "Faces cut where they intersected, once in each repetition.");
    count("covered_faces", &C::covered_faces,
          "Faces that intersected nothing and lay inside another component.");
    count("touching_edges", &C::touching_edges,
          "Edges of more than two faces that unions made, where solids touch.");
    count("intersecting_faces", &C::intersecting_faces, "Faces that intersected and were replaced.");
    count("moved_apart", &C::moved_apart, "Vertices that were moved away from another at the same position.");
    d.field(
         "farthest_apart",
         [](const CleanedPart& p) {
             const CleanCounts& c = p.counts;
             return c.moved_apart > 0 ? std::optional(c.farthest_apart) : std::nullopt;
         },
         "How far one of them was moved at most, in the units of its part.")
        .only_when("vertices were moved apart");
    d.field("scaled", &CleanedPart::scaled, "Normals, tangents and sets of joint weights that were scaled.");
    d.list("not_done", &CleanedPart::not_done, "The first ten repairs that were not done.", declare_not_done);
}

} // namespace

void declare_clean_report(DeclareFields<CleanReport>& d) {
    d.list("parts", &CleanReport::parts, "Each part that was cleaned.", declare_part)
        .tallied("nothing to repair");
}

std::vector<NotDone> first_not_done(const std::vector<NotDone>& all, const Transform& to_world) {
    constexpr std::size_t most = 10;
    std::vector<NotDone> first(all.begin(),
                               all.begin() + static_cast<std::ptrdiff_t>(std::min(most, all.size())));
    for (NotDone& one : first) one.at = to_world.point(one.at);
    return first;
}

} // namespace facetmill::clean_stage
