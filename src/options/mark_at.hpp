#pragma once
// Where a problem with an option is told.

#include "options/value.hpp"

namespace facetmill {

/// The place of what was given for the option, or of all that was given when it was left out or the value
/// stands alone.
inline const Mark& mark_at(const Value& given, std::string_view option) {
    const Value* value = given.find(option);
    return value ? value->mark : given.mark;
}

} // namespace facetmill
