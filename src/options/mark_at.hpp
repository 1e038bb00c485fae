#pragma once
// Where a problem with an option is told, and what an option is refused for.

#include "base/refusal.hpp"
#include "options/value.hpp"

namespace facetmill {

/// The place of what was given for the option, or of all that was given when it was left out or the value
/// stands alone.
inline const Mark& mark_at(const Value& given, std::string_view option) {
    const Value* value = given.find(option);
    return value ? value->mark : given.mark;
}

/// Adds the refusal, if there is one, where its option stands. owner: the stage, "split".
inline void add_refusal(const std::optional<Refusal>& refusal, std::string_view owner, const Value& given,
                        Problems& problems) {
    if (refusal)
        problems.add(mark_at(given, refusal->option), refusal->id, refusal_text(owner, *refusal),
                     refusal->hint);
}

} // namespace facetmill
