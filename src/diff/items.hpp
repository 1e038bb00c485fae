#pragma once
// The parts and the materials of two scenes by their names: what came, went and changed.

#include "mesh/scene.hpp"

#include <string>
#include <vector>

namespace facetmill::report {

struct ItemChange {
    enum class Change { added, removed, changed, same };
    bool is_part = true; ///< else a material
    std::string name;    ///< of several with one name, the first of one is the first of the other
    Change change = Change::same;
    std::string before, after; ///< what is told of each: "1,200 faces"; empty: it is not there
    std::string note;          ///< how a changed one differs
};
const char* to_string(ItemChange::Change change);

/// Parts first, each list in the order of the first scene, then what only the second has. A part is the same
/// when its counts are and none of its points is farther than `most` from its own before, in world space. A
/// material is, when colour, sides and all that glTF says of it are. O(n).
std::vector<ItemChange> item_changes(const Scene& a, const Scene& b, double most);

} // namespace facetmill::report
