#pragma once
// Counts the results of a stage that cuts parts. In a scene of many parts, unchanged and removed parts are
// normal. A warning is useful only if all parts are unchanged, or all are removed.

#include "base/text/readable_numbers.hpp"
#include "mesh/scene.hpp"
#include "options/fields.hpp"

#include <fmt/format.h>
#include <string>

namespace facetmill {

struct KeptParts {
    std::size_t emptied = 0;   ///< parts without any remaining faces or points
    std::size_t untouched = 0; ///< unchanged parts
    std::size_t cut = 0;       ///< other parts; initially empty parts are not counted
    std::string first;         ///< the name of the first part

    /// had, left: faces of the part before and after, or points of a part without faces. changed: the part
    /// was modified.
    void add(const Part& part, std::size_t had, std::size_t left, bool changed) {
        if (had == 0) return;
        if (all() == 0) first = part.name;
        ++(left == 0 ? emptied : changed ? cut : untouched);
    }
    std::size_t all() const { return emptied + untouched + cut; }
    bool are_all_emptied() const { return emptied > 0 && emptied == all(); }
    bool are_all_untouched() const { return untouched > 0 && untouched == all(); }
    /// The subject of a warning: "part 'wheel'" or "the scene (12 parts)".
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
        "Parts that were kept unchanged.");
    d.field(
        "emptied_parts", [kept](const Report& r) { return (r.*kept).emptied; },
        "Parts that lost all their faces or points.");
}

} // namespace facetmill
