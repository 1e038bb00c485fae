#pragma once
// What split says of a part.

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

/// What ended the work, by the option that asked for it.
const char* stopped_by(const SplitOptions& o, SplitResult::Stop stop);

/// Says which target was not reached; `longest`: the longest edge that is left, in world units.
void warn_of_targets(const Part& part, const SplitResult& r, const SplitSettings& s, double longest,
                     Context& context);
/// Says where faces cannot be split as well as the stage promises.
void warn_of_spots(const Part& part, const SplitResult& r, SplitMethod method, Context& context);

} // namespace facetmill::split_stage
