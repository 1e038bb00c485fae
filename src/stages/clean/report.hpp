#pragma once
// The report of clean: completed repairs, and repairs that were not possible.

#include "geometry/clean/clean.hpp"
#include "options/fields.hpp"

namespace facetmill::clean_stage {

struct CleanedPart {
    std::string part;
    CleanCounts counts;
    std::size_t scaled = 0;        ///< vectors and weights of wedges
    std::vector<NotDone> not_done; ///< the first few, in world space
};

struct CleanReport {
    std::vector<CleanedPart> parts;
};
void declare_clean_report(DeclareFields<CleanReport>& d);

/// The first few repairs that were not possible, with positions in world space.
[[nodiscard]] std::vector<NotDone> first_not_done(const std::vector<NotDone>& all, const Transform& to_world);

} // namespace facetmill::clean_stage
