#pragma once
// What became of the attributes of a mesh: every operation that touches them returns such a list, and the
// report prints it. Here is how the lists of several operations become one.

#include "mesh/attribute.hpp"

#include <string_view>

namespace facetmill {

/// What became of an attribute in a stage: an entry of the report's list of attribute changes.
struct AttributeChange {
    enum class Kind { kept, interpolated, recomputed, dropped };
    std::string attribute;
    Domain domain = Domain::wedge;
    Kind kind = Kind::kept;
    std::string why; ///< empty for kept

    bool operator==(const AttributeChange&) const = default;
};
const char* to_string(AttributeChange::Kind kind);
using AttributeChanges = std::vector<AttributeChange>;

/// All of the attributes, kept.
AttributeChanges kept_changes(const std::vector<Attribute>& attributes);

/// Adds what a further operation did, beside or after the others: of an attribute that is in both lists, what
/// `more` says unless it says kept. The order is that of first mention.
void merge_changes(AttributeChanges& all, const AttributeChanges& more);

/// What two steps in a row did: the attributes of the second, in its order; what the second one kept is what
/// the first one made of it.
AttributeChanges changes_in_sequence(const AttributeChanges& first, AttributeChanges second);

/// Takes the entries of the attribute out: one that an operation made for its own use says nothing to users.
void forget_change(AttributeChanges& changes, std::string_view attribute);

} // namespace facetmill
