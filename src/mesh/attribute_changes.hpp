#pragma once
// The changes of the attributes of a mesh. Every operation that changes attributes returns such a list, and
// the report prints it. These functions merge the lists of several operations.

#include "mesh/attribute.hpp"

#include <string_view>

namespace facetmill {

/// The change of an attribute in a stage: an entry of the report's list of attribute changes.
struct AttributeChange {
    enum class Kind { kept, interpolated, recomputed, dropped };
    std::string attribute;
    Domain domain = Domain::wedge;
    Kind kind = Kind::kept;
    std::string why; ///< empty for kept attributes

    bool operator==(const AttributeChange&) const = default;
};
[[nodiscard]] const char* to_string(AttributeChange::Kind kind);
using AttributeChanges = std::vector<AttributeChange>;

/// Marks all of the attributes as kept.
[[nodiscard]] AttributeChanges kept_changes(const std::vector<Attribute>& attributes);

/// Adds the changes of a parallel or later operation. For an attribute in both lists, the entry in `more` is
/// used unless it is kept. The order is by first occurrence.
void merge_changes(AttributeChanges& all, const AttributeChanges& more);

/// The changes of two consecutive steps: the attributes of the second, in its order. Attributes that the
/// second kept have their change in the first.
[[nodiscard]] AttributeChanges changes_in_sequence(const AttributeChanges& first, AttributeChanges second);

/// Removes the entries of an attribute for internal use.
void forget_change(AttributeChanges& changes, std::string_view attribute);

} // namespace facetmill
