#pragma once
// JSON as files mostly have it, read several times as fast as by the library.

#include "base/json.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace facetmill {

/// The value that a JSON text stands for, the same as the library gives. None for a text that is no JSON, for
/// one that is nested deeper than `deepest` levels, and for the rare ones that only the library reads: a byte
/// order mark, perhaps numbers next to zero. The library says what is wrong, if anything is. Its time grows
/// with the square of an object's members, that of this with their number.
/// unread: members of the outermost object that are checked like the others; of them, arrays and objects come
/// out empty.
std::optional<Json> quick_json(std::string_view text, int deepest = 256,
                               std::span<const std::string_view> unread = {});

} // namespace facetmill
