#include "stages/split/report.hpp"

#include "base/portable_math.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

const char* stopped_by(const SplitOptions& o, SplitResult::Stop stop) {
    switch (stop) {
    case SplitResult::Stop::passes:
        return "passes";
    case SplitResult::Stop::target:
        return o.max_edge ? "max_edge" : "min_angle";
    case SplitResult::Stop::budget:
        return "faces";
    case SplitResult::Stop::nothing:
        break;
    }
    return "nothing";
}

} // namespace

Json described(const SplitOptions& o, const Part& part, const SplitResult& r, const FacetShape& before,
               const FacetShape& after) {
    const auto degrees = [](double radians) { return radians * (180 / pi); };
    return {{"part", part.name},
            {"added_faces", r.added},
            {"passes", r.passes},
            {"stopped_by", stopped_by(o, r.stop)},
            {"longest_edge", {{"before", before.longest_edge}, {"after", after.longest_edge}}},
            {"smallest_angle",
             {{"before", degrees(before.smallest_angle)}, {"after", degrees(after.smallest_angle)}}}};
}

void warn_of_targets(const Part& part, const SplitResult& r, const SplitSettings& s, double longest,
                     Context& context) {
    const bool out_of_room = r.stop == SplitResult::Stop::budget;
    if (out_of_room && r.added == 0)
        context.warn(
            "W-SPLIT-NOTHING",
            fmt::format("part '{}' has {} faces, and its share of the target is {}: nothing is split",
                        part.name, part.mesh.face_count(), s.faces),
            "give a larger target; simplify makes fewer faces");
    else if (s.max_edge > 0 && r.stop != SplitResult::Stop::target)
        context.warn(
            "W-SPLIT-STOPPED",
            fmt::format("part '{}' has edges of {:.4g} left, above max_edge {:.4g}: {} ended the split",
                        part.name, longest, s.max_edge,
                        out_of_room ? std::string("faces") : fmt::format("passes ({})", s.passes)),
            out_of_room ? "allow more faces, or a longer max_edge"
                        : "allow more passes, or a longer max_edge");
}

void warn_of_spots(const Part& part, const SplitResult& r, SplitMethod method, Context& context) {
    if (r.folded > 0)
        context.warn(
            "W-SPLIT-FOLDED",
            fmt::format("in part '{}' {} faces are concave or cross themselves: pieces that {} makes "
                        "of them lie over each other",
                        part.name, r.folded, to_string(method)),
            "triangulate before it, or 'split: diagonal' for quads");
    if (r.shared > 0)
        context.warn("W-SPLIT-SHARED",
                     fmt::format("in part '{}' faces share two edges at {} places: their new edges there "
                                 "coincide and have more than two faces",
                                 part.name, r.shared),
                     "clean removes doubled faces; 'split: centroid' makes no such edges");
}

} // namespace facetmill
