#pragma once
// Parses lists in a single text, as in one-liners: "1, 2, 3", "[1, 2, 3]", "1,2; 3,4" and "[[1, 2], [3,
// 4]]".

#include "options/value.hpp"

#include <optional>

namespace facetmill {

/// Parses a scalar's text as a list. Its items have the scalar's mark, and no blanks around them. Items are
/// separated by commas and may be lists in brackets; semicolons separate rows. A text without these is a
/// list of a single item; "[]" is empty. None if brackets do not match.
[[nodiscard]] std::optional<Value> list_in_text(const Value& text);

/// The items between the commas of "a, b" or "[a, b]". Items may contain brackets and semicolons, as names
/// do. All items have the mark.
[[nodiscard]] Value list_of_words(std::string_view text, const Mark& mark);

/// The value, or for a scalar the list in its text.
[[nodiscard]] Value listed(const Value& value);

} // namespace facetmill
