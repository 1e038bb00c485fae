#pragma once
// Finds the location of a problem with an option, and adds refusals.

#include "base/refusal.hpp"
#include "options/value.hpp"

namespace facetmill {

/// The mark of the option's value, or of the whole value if the option is missing or the value is bare.
inline const Mark& mark_at(const Value& given, std::string_view option) {
    const Value* value = given.find(option);
    return value ? value->mark : given.mark;
}

/// Adds the refusal, if any, at the mark of its option. owner: the stage, "split".
inline void add_refusal(const std::optional<Refusal>& refusal, std::string_view owner, const Value& given,
                        Problems& problems) {
    if (refusal)
        problems.add(mark_at(given, refusal->option), refusal->id, refusal_text(owner, *refusal),
                     refusal->hint);
}

} // namespace facetmill
