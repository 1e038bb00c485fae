#include "stages/clean/report.hpp"

#include <algorithm>

namespace facetmill::clean_stage {

namespace {

void declare_not_done(DeclareFields<NotDone>& d) {
    d.field("step", &NotDone::step, "The step that failed.");
    d.field("why", &NotDone::why, "The reason.");
    d.field("at", &NotDone::at, "The position in world space.");
}

void declare_part(DeclareFields<CleanedPart>& d) {
    d.field("part", &CleanedPart::part, "The name of the part.");
    d.field(
        "changed",
        [](const CleanedPart& p) {
            return p.counts.total() + p.scaled + (p.hidden ? p.hidden->faces : 0) > 0;
        },
        "Whether the part was changed.");
    const auto count = [&](const char* name, std::size_t CleanCounts::*member, const char* help) {
        d.field(
            name, [member](const CleanedPart& p) { return p.counts.*member; }, help);
    };
    using C = CleanCounts;
    count("rounded_vertices", &C::rounded_vertices, "Vertices rounded to 32-bit coordinates.");
    count("welded_vertices", &C::welded_vertices, "Vertices merged into others.");
    count("degenerate_faces", &C::degenerate_faces, "Removed faces without area.");
    count("repeated_corners", &C::repeated_corners, "Removed corners that repeated the previous corner.");
    count("duplicate_faces", &C::duplicate_faces, "Removed duplicate faces.");
    count("t_junctions", &C::t_junctions, "Vertices inserted into boundary edges.");
    count("stitched_edges", &C::stitched_edges, "Joined pairs of boundary edges.");
    count("split_vertices", &C::split_vertices, "Separated vertices that connected several fans of faces.");
    count("split_edges", &C::split_edges, "Separated edges with more than two faces.");
    count("filled_holes", &C::filled_holes, "Filled holes.");
    count("hole_faces", &C::hole_faces, "Faces that fill the holes.");
    count("removed_open_components", &C::open_components, "Removed components that stayed open.");
    count("open_component_faces", &C::open_component_faces, "Faces of the removed open components.");
    count("removed_components", &C::components, "Removed small components.");
    count("component_faces", &C::component_faces, "Faces of the removed small components.");
    d.field(
         "component_area", [](const CleanedPart& p) { return p.counts.component_area; },
         "The area of the removed small components.")
        .unit("square scene units");
    const auto hidden = [&](const char* name, auto member, const char* help) {
        using Value = std::decay_t<decltype(std::declval<HiddenCounts>().*member)>;
        return d
            .field(
                name,
                [member](const CleanedPart& p) {
                    return p.hidden ? std::optional<Value>((*p.hidden).*member) : std::nullopt;
                },
                help)
            .only_when("hidden is true");
    };
    hidden("hidden_faces", &HiddenCounts::faces, "Removed faces that no ray reached.").field().count =
        [](const void* part) {
            const auto& removed = static_cast<const CleanedPart*>(part)->hidden;
            return removed ? std::uint64_t{removed->faces} : std::uint64_t{0};
        };
    hidden("hidden_area", &HiddenCounts::area, "The area of the removed hidden faces.")
        .unit("square scene units");
    hidden("outer_rays", &HiddenCounts::outer_rays, "The number of rays cast from outside the scene.");
    hidden("face_rays", &HiddenCounts::face_rays,
           "The number of rays cast from faces that no ray from outside reached.");
    count("removed_inner_components", &C::inner_components, "Removed components inside others.");
    count("inner_component_faces", &C::inner_component_faces, "Faces of the removed inner components.");
    count("isolated_vertices", &C::isolated_vertices, "Removed vertices without faces.");
    count("united_components", &C::united_components,
          "Intersecting closed components that became part of a union.");
    count("refined_faces", &C::refined_faces, "Faces cut at intersections, counted in each repetition.");
    count("covered_faces", &C::covered_faces,
          "Removed faces that intersected nothing and were inside another component.");
    count("touching_edges", &C::touching_edges,
          "Edges with more than two faces that unions created where solids touch.");
    count("intersecting_faces", &C::intersecting_faces, "Intersecting faces that were replaced.");
    count("moved_apart", &C::moved_apart, "Vertices moved away from others at the same position.");
    d.field(
         "farthest_apart",
         [](const CleanedPart& p) {
             const CleanCounts& c = p.counts;
             return c.moved_apart > 0 ? std::optional(c.farthest_apart) : std::nullopt;
         },
         "The largest distance that a vertex was moved apart, in the units of its part.")
        .only_when("vertices were moved apart");
    d.field("scaled", &CleanedPart::scaled, "Normals, tangents and sets of joint weights that were scaled.");
    d.list("not_done", &CleanedPart::not_done, "The first ten repairs that failed.", declare_not_done);
}

} // namespace

void declare_clean_report(DeclareFields<CleanReport>& d) {
    d.list("parts", &CleanReport::parts, "Every cleaned part.", declare_part).tallied("nothing to repair");
}

std::vector<NotDone> first_not_done(const std::vector<NotDone>& all, const Transform& to_world) {
    constexpr std::size_t most = 10;
    std::vector<NotDone> first(all.begin(),
                               all.begin() + static_cast<std::ptrdiff_t>(std::min(most, all.size())));
    for (NotDone& one : first) one.at = to_world.point(one.at);
    return first;
}

} // namespace facetmill::clean_stage
