#pragma once
// The report of clean: completed repairs, and repairs that were not possible.

#include "geometry/clean/clean.hpp"
#include "options/fields.hpp"

namespace facetmill::clean_stage {

/// Faces that were removed because no ray reached them.
struct HiddenCounts {
    std::size_t faces = 0;
    double area = 0;                           ///< in world space
    std::size_t outer_rays = 0, face_rays = 0; ///< of the whole scene
};

struct CleanedPart {
    std::string part;
    CleanCounts counts;
    std::size_t scaled = 0;             ///< vectors and weights of wedges
    std::optional<HiddenCounts> hidden; ///< with hidden: true
    std::vector<NotDone> not_done;      ///< the first few, in world space
};

struct CleanReport {
    std::vector<CleanedPart> parts;
};
void declare_clean_report(DeclareFields<CleanReport>& d);

/// The first few repairs that were not possible, with positions in world space.
[[nodiscard]] std::vector<NotDone> first_not_done(const std::vector<NotDone>& all, const Transform& to_world);

} // namespace facetmill::clean_stage
