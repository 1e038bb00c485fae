#pragma once
// Compares the parts and the materials of two scenes by name: added, removed and changed.

#include "mesh/scene.hpp"

#include <string>
#include <vector>

namespace facetmill::report {

struct ItemChange {
    enum class Change { added, removed, changed, same };
    bool is_part = true; ///< else a material
    std::string name;    ///< equal names are matched in order
    Change change = Change::same;
    std::string before, after; ///< descriptions of each: "1,200 faces"; empty: missing
    std::string note;          ///< how a changed one differs
};
const char* to_string(ItemChange::Change change);

/// Parts first, each list in the order of the first scene, followed by items only in the second. A part is
/// the same if its counts are and no point moved farther than `most` in world space. A material is the same
/// if colour, sides and all its glTF properties are. O(n).
std::vector<ItemChange> item_changes(const Scene& a, const Scene& b, double most);

} // namespace facetmill::report
