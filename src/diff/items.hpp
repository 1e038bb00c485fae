#pragma once
// Pairs the parts and materials of two scenes by name, and finds added, removed and changed items.

#include "mesh/scene.hpp"

#include <string>
#include <vector>

namespace facetmill::report {

struct ItemChange {
    enum class Change { added, removed, changed, same };
    bool is_part = true; ///< true: a part; false: a material
    std::string name;    ///< several items with the same name are paired in order
    Change change = Change::same;
    std::string before, after; ///< description: "1,200 faces"; empty: missing
    std::string note;          ///< the difference of a changed item
};
[[nodiscard]] const char* to_string(ItemChange::Change change);

/// Parts first, each list in the order of the first scene, then items that only the second has. Two parts are
/// equal if their counts match and no point moved farther than `most`, in world space. Two materials are
/// equal if colour, sides and all glTF data match. O(n).
[[nodiscard]] std::vector<ItemChange> item_changes(const Scene& a, const Scene& b, double most);

} // namespace facetmill::report
