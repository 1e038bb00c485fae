#pragma once
// The report and warnings of split.

#include "stages/split/options.hpp"

namespace facetmill::split_stage {

struct SplitPart {
    std::string part;
    std::size_t added_faces = 0;
    int passes = 0;
    std::string stopped_by;
    std::optional<std::size_t> narrow, narrow_before;
    FacetShape before, after;
};

struct SplitReport {
    std::size_t added_faces = 0;
    std::vector<SplitPart> parts;
};
void declare_split_report(DeclareFields<SplitReport>& d);

/// The option that ended the split.
[[nodiscard]] const char* stopped_by(const SplitOptions& o, SplitResult::Stop stop);

/// Warns of targets that were not reached. longest: the longest remaining edge in world units.
void warn_of_targets(const Part& part, const SplitResult& r, const SplitSettings& s, double longest,
                     Context& context);
/// Warns of faces that cannot be split as well as documented.
void warn_of_spots(const Part& part, const SplitResult& r, SplitMethod method, Context& context);

} // namespace facetmill::split_stage
