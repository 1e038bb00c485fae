#pragma once
// What clean did, and what it did not, for reports.

#include "geometry/clean/clean.hpp"
#include "options/fields.hpp"

namespace facetmill::clean_stage {

struct CleanedPart {
    std::string part;
    CleanCounts counts;
    std::vector<NotDone> not_done; ///< the first few, in the world
};

struct CleanReport {
    std::vector<CleanedPart> parts;
};
void declare_clean_report(DeclareFields<CleanReport>& d);

/// The first few repairs that were not done, with their places in the world.
std::vector<NotDone> first_not_done(const std::vector<NotDone>& all, const Transform& to_world);

} // namespace facetmill::clean_stage
