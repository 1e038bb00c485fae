#pragma once
// What a stage that cuts the parts of a scene left of them: of many parts it is normal that some stay whole
// and others go, and worth a warning only when that is so of all.

#include "base/text/readable_numbers.hpp"
#include "mesh/scene.hpp"
#include "options/fields.hpp"

#include <fmt/format.h>
#include <string>

namespace facetmill {

struct KeptParts {
    std::size_t emptied = 0;   ///< parts of which nothing was kept
    std::size_t untouched = 0; ///< parts that were kept as they are
    std::size_t cut = 0;       ///< the others; parts that had nothing count nowhere
    std::string first;         ///< the name of the first of them

    /// had, left: faces of the part, or points of one without faces. changed: whether what is left is not
    /// what there was.
    void add(const Part& part, std::size_t had, std::size_t left, bool changed) {
        if (had == 0) return;
        if (all() == 0) first = part.name;
        ++(left == 0 ? emptied : changed ? cut : untouched);
    }
    std::size_t all() const { return emptied + untouched + cut; }
    bool are_all_emptied() const { return emptied > 0 && emptied == all(); }
    bool are_all_untouched() const { return untouched > 0 && untouched == all(); }
    /// "part 'wheel'", "the scene (12 parts)".
    std::string all_of_them() const {
        return all() == 1 ? fmt::format("part '{}'", first)
                          : fmt::format("the scene ({} parts)", grouped(all()));
    }
};

/// Declares `untouched_parts` and `emptied_parts`.
template <class Report>
void declare_kept_parts(DeclareFields<Report>& d, KeptParts Report::*kept) {
    d.field(
        "untouched_parts", [kept](const Report& r) { return (r.*kept).untouched; },
        "Parts that were kept as they are.");
    d.field(
        "emptied_parts", [kept](const Report& r) { return (r.*kept).emptied; },
        "Parts of which nothing was kept.");
}

} // namespace facetmill
