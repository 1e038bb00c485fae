#include "stages/split/report.hpp"

#include "base/math/portable_math.hpp"
#include "base/text/words.hpp"

#include <fmt/format.h>

namespace facetmill::split_stage {

namespace {

/// A measure of the shape before and after.
template <class Get>
auto change_of(Get get, const char* unit) {
    return [get, unit](DeclareFields<SplitPart>& d) {
        const auto before = [get](const SplitPart& p) { return get(p.before); };
        const auto after = [get](const SplitPart& p) { return get(p.after); };
        d.field("before", before, "Before the stage.").unit(unit);
        d.field("after", after, "After the stage.").unit(unit);
    };
}

void declare_part(DeclareFields<SplitPart>& d) {
    d.field("part", &SplitPart::part, "The name of the part.");
    d.field("added_faces", &SplitPart::added_faces, "The number of added faces.");
    d.field("passes", &SplitPart::passes, "The number of passes.");
    d.choice("stopped_by", &SplitPart::stopped_by,
             {{"passes", "passes", "the requested number was done"},
              {"max_edge", "max_edge", "no edge is longer"},
              {"min_angle", "min_angle", "no triangle has a smaller angle"},
              {"max_faces", "max_faces", "the next cut would exceed it"},
              {"narrow", "narrow", "a pass would have made more triangles with a smaller angle"},
              {"nothing", "nothing", "no edge has a length"}},
             "The reason why the split ended.");
    d.field("narrow", &SplitPart::narrow, "Remaining triangles with a smaller angle.")
        .only_when("min_angle is given");
    d.field("narrow_before", &SplitPart::narrow_before, "Triangles with a smaller angle before.")
        .only_when("min_angle is given");
    const auto self = [](const SplitPart& p) -> const SplitPart& { return p; };
    const auto longest = [](const FacetShape& s) { return s.longest_edge; };
    const auto smallest = [](const FacetShape& s) { return s.smallest_angle * (180 / pi); };
    d.object("longest_edge", self, "The longest edge.", change_of(longest, "scene units"));
    d.object("smallest_angle", self, "The smallest angle.", change_of(smallest, "degrees"));
}

} // namespace

void declare_split_report(DeclareFields<SplitReport>& d) {
    d.field("added_faces", &SplitReport::added_faces, "The number of faces added in all parts.");
    d.list("parts", &SplitReport::parts, "Each part that was split.", declare_part);
}

const char* stopped_by(const SplitOptions& o, SplitResult::Stop stop) {
    switch (stop) {
    case SplitResult::Stop::passes:
        return "passes";
    case SplitResult::Stop::target:
        return o.max_edge ? "max_edge" : "min_angle";
    case SplitResult::Stop::budget:
        return "max_faces";
    case SplitResult::Stop::narrow:
        return "narrow";
    case SplitResult::Stop::nothing:
        break;
    }
    return "nothing";
}

namespace {

/// The faces that a method without a target splits, if not all.
const char* only_splits(SplitMethod method) {
    switch (method) {
    case SplitMethod::fan:
        return "faces of four and more corners";
    case SplitMethod::halve:
    case SplitMethod::diagonal:
        return "quads";
    case SplitMethod::midpoint:
    case SplitMethod::bisect:
    case SplitMethod::notch:
    case SplitMethod::centroid:
    case SplitMethod::grid:
    case SplitMethod::quads:
    case SplitMethod::varignon:
    case SplitMethod::core:
    case SplitMethod::loop:
    case SplitMethod::sqrt3:
    case SplitMethod::butterfly:
    case SplitMethod::catmull_clark:
        break;
    }
    return nullptr;
}

void warn_of_narrow_faces(const Part& part, const SplitResult& r, const SplitSettings& s, Context& context) {
    const bool narrow = r.stop == SplitResult::Stop::narrow;
    const std::string faces = fmt::format("{} with an angle below {:.4g} degrees", counted(r.narrow, "face"),
                                          s.min_angle * (180 / pi));
    const std::string left = r.passes > 0 ? fmt::format(": {} {} left ({} before)", faces,
                                                        r.narrow == 1 ? "is" : "are", r.narrow_before)
                                          : " stays unchanged, with " + faces;
    context.warn("W-SPLIT-STOPPED",
                 fmt::format("part '{}'{}: {}", part.name, left,
                             narrow ? "the next pass would make more of them" : "passes ended the split"),
                 "a split never makes an angle larger: use relax to even out faces, or simplify to remove "
                 "narrow ones");
}

} // namespace

void warn_of_targets(const Part& part, const SplitResult& r, const SplitSettings& s, double longest,
                     Context& context) {
    const bool out_of_room = r.stop == SplitResult::Stop::budget;
    if (out_of_room && r.added == 0)
        context.warn("W-SPLIT-NOTHING",
                     fmt::format("part '{}' has {} faces, and its share of max_faces is {}: nothing is split",
                                 part.name, part.mesh.face_count(), s.max_faces),
                     "give a larger max_faces; simplify reduces the number of faces");
    else if (s.max_edge > 0 && r.stop != SplitResult::Stop::target)
        context.warn(
            "W-SPLIT-STOPPED",
            fmt::format("part '{}' still has edges of {:.4g}, above max_edge {:.4g}: {} ended the split",
                        part.name, longest, s.max_edge,
                        out_of_room ? std::string("max_faces") : fmt::format("passes ({})", s.passes)),
            out_of_room ? "give a larger max_faces, or a longer max_edge"
                        : "allow more passes, or a longer max_edge");
    else if (s.min_angle > 0 && r.narrow > 0)
        warn_of_narrow_faces(part, r, s, context);
    else if (const char* kind = only_splits(s.method);
             kind && r.passes > 0 && r.added == 0 && part.mesh.face_count() > 0)
        context.warn("W-SPLIT-NOTHING",
                     fmt::format("part '{}' stays unchanged: {} splits only {}, and the part has none",
                                 part.name, to_string(s.method), kind),
                     "use midpoint, centroid or quads, which split faces of all kinds");
}

void warn_of_spots(const Part& part, const SplitResult& r, SplitMethod method, Context& context) {
    if (r.folded > 0)
        context.warn(
            "W-SPLIT-FOLDED",
            fmt::format(
                "in part '{}' {} faces are concave or intersect themselves, so the new faces from {} overlap",
                part.name, r.folded, to_string(method)),
            "use triangulate first, or 'split: diagonal' for quads");
    if (r.shared > 0)
        context.warn("W-SPLIT-SHARED",
                     fmt::format("in part '{}' faces share two edges at {} vertices: their new edges there "
                                 "coincide and have more than two faces",
                                 part.name, r.shared),
                     "use clean to remove duplicate faces; 'split: centroid' makes no such edges");
}

} // namespace facetmill::split_stage
