#include "stages/crumple/report.hpp"

#include "base/math/numbers.hpp"
#include "base/text/readable_numbers.hpp"
#include "mesh/face.hpp"
#include "mesh/placement.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::crumple_stage {

namespace {

/// The original position of the face of the split mesh in world space: the mean of its corners.
Vec3 place_of(const CrumpledPart& work, Index face) {
    return work.to_world.point(corner_mean(work.part->mesh, face, work.before));
}

Box world_box(const Part& part) {
    Box box;
    for (const Vec3& p : part.mesh.positions) box.add(in_world(part, p));
    return box;
}

void declare_shares(DeclareFields<AvoidResult>& d) {
    const std::size_t last = AvoidResult{}.shares.size() - 1;
    for (std::size_t i = 0; i <= last; ++i)
        d.field(
            i == 0      ? "1"
            : i == last ? "0"
                        : fmt::format("1/{}", 1 << i),
            [i](const AvoidResult& r) { return r.shares[i]; }, "Vertices that moved by this share.");
}

void declare_avoided(DeclareFields<AvoidResult>& d) {
    d.field(
        "scope", [](const AvoidResult&) { return "faces of the same part"; },
        "The scope of the check for intersections.");
    d.field("before", &AvoidResult::exempt, "Intersecting pairs of faces before.");
    d.field("found", &AvoidResult::found,
            "Faces that would intersect, lose their area, or stretch beyond eight times their longest edge, "
            "if all vertices moved by their full displacement. The limit of the stretch is lower if most "
            "faces would intersect.");
    d.field("rounds", &AvoidResult::rounds, "The number of rounds that lowered shares.");
    d.field("coarse", &AvoidResult::coarse,
            "Positions whose shares were lowered in large steps to limit the work (W-CRUMPLE-COARSE).");
    const auto self = [](const AvoidResult& r) -> const AvoidResult& { return r; };
    d.object("vertices_by_share", self, "The number of vertices for each share of the displacement.",
             declare_shares);
}

void declare_part(DeclareFields<CrumpleReportPart>& d) {
    d.field("part", &CrumpleReportPart::part, "The name of the part.");
    d.field("added_faces", &CrumpleReportPart::added_faces, "The number of added faces.");
    d.field("moved_vertices", &CrumpleReportPart::moved, "Vertices that moved.");
    d.field("held_vertices", &CrumpleReportPart::held_vertices,
            "Vertices that did not move because of the boundary, caps or the mask.");
    d.field("largest_move", &CrumpleReportPart::largest_move, "The largest displacement of a vertex.")
        .unit("scene units");
    d.field("root_mean_square_move", &CrumpleReportPart::root_mean_square,
            "The root mean square displacement of all vertices.")
        .unit("scene units");
}

} // namespace

void declare_crumple_report(DeclareFields<CrumpleReport>& d) {
    d.object("self_intersections", &CrumpleReport::self_intersections,
             "The result of avoiding intersections.", declare_avoided)
        .only_when("self_intersections is avoid or forbid");
    d.list("parts", &CrumpleReport::parts, "Each crumpled part.", declare_part);
}

void refuse_intersections(const AvoidResult& r, std::span<const CrumpledPart> parts, std::int64_t grid) {
    const CrumpledPart& work = parts[r.first_sheet];
    const auto pieces = static_cast<Index>(grid * grid); // each face became this many consecutive faces
    const Index a = r.first.first / pieces, b = r.first.second / pieces;
    const Vec3 p = place_of(work, r.first.first);
    throw Error(
        ErrorKind::stage, "E-INTERSECTS",
        fmt::format("crumple: {}{} pairs of {} would intersect, first {} of part '{}', near ({})",
                    r.at_least ? "at least " : "", r.found, grid > 1 ? "subdivided faces" : "faces",
                    a == b ? fmt::format("in face {} itself", a) : fmt::format("faces {} and {}", a, b),
                    work.part->name, readable(p, ", ")),
        "use self_intersections: avoid, or a smaller amplitude");
}

void warn_of_coarse_steps(const AvoidResult& r, Context& context) {
    if (r.coarse == 0) return;
    context.warn("W-CRUMPLE-COARSE",
                 fmt::format("crumple: so many faces would intersect that the shares of {} positions were "
                             "lowered in large steps to limit the work: they move less than necessary",
                             r.coarse),
                 "use a smaller amplitude, or a smaller grid, which gives larger faces");
}

void warn_of_tangles(const std::string& part, double mean_edge, double amplitude, Context& context) {
    if (!(amplitude > mean_edge && mean_edge > 0)) return;
    context.warn(
        "W-AMPLITUDE",
        fmt::format(
            "crumple: the amplitude {:.3g} is larger than the mean edge {:.3g} of part '{}': faces intersect",
            amplitude, mean_edge, part),
        fmt::format("use self_intersections: avoid, or an amplitude below about {:.2g}", mean_edge / 4));
}

void warn_of_folds(const CrumpledPart& work, Context& context) {
    if (work.pieces.folded > 0)
        context.warn(
            "W-SPLIT-FOLDED",
            fmt::format("in part '{}' {} faces are concave or intersect themselves, so the new faces overlap",
                        work.part->name, work.pieces.folded),
            "use triangulate first");
}

void warn_of_rounding(const CrumpledPart& part, const CrumpleMoves& moves, double amplitude,
                      Context& context) {
    double farthest = 0;
    for (std::size_t v = 0; v < part.before.size(); ++v) {
        const Vec3 to = part.before[v] + moves.moves[v];
        const Vec3 rounded = as_float32(to);
        farthest = std::max(farthest, length(part.to_world.vector(rounded - to)));
    }
    if (!(amplitude > 0 && farthest > amplitude / 100)) return;
    context.warn(
        "W-CRUMPLE-ROUNDED",
        fmt::format("crumple: to avoid intersections, positions of part '{}' are rounded to float32, which "
                    "moves a vertex by {:.3g}, more than 1 % of the amplitude {:.3g}",
                    part.part->name, farthest, amplitude),
        "move the part to its origin first, or use self_intersections: allow");
}

void warn_of_parts(const Scene& scene, Context& context) {
    std::vector<Box> boxes;
    for (const Part& part : scene.parts) boxes.push_back(world_box(part));
    const auto overlap = [&](const Box& a, const Box& b) {
        bool both = !a.empty() && !b.empty();
        for (std::size_t i = 0; i < 3; ++i) both = both && a.min[i] <= b.max[i] && b.min[i] <= a.max[i];
        return both;
    };
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = i + 1; j < boxes.size(); ++j) {
            const Part &a = scene.parts[i], &b = scene.parts[j];
            if (!overlap(boxes[i], boxes[j])) continue;
            if (!context.selects(a, scene) && !context.selects(b, scene)) continue;
            return context.warn("W-CRUMPLE-PARTS",
                                fmt::format("crumple avoids intersections only within a part; the boxes of "
                                            "the parts '{}' and '{}' overlap, so their faces may intersect",
                                            a.name, b.name),
                                "use merge first to join them");
        }
}

} // namespace facetmill::crumple_stage
