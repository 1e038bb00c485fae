#pragma once
// The added, removed and changed parts and materials of two scenes, by name.

#include "mesh/scene.hpp"

#include <string>
#include <vector>

namespace facetmill::report {

struct ItemChange {
    enum class Change { added, removed, changed, same };
    bool is_part = true; ///< else a material
    std::string name;    ///< items with the same name are paired in order
    Change change = Change::same;
    std::string before, after; ///< the descriptions: "1,200 faces"; empty: missing
    std::string note;          ///< the difference of a changed item
};
const char* to_string(ItemChange::Change change);

/// Parts first, then materials; each list in the order of the first scene, then items only in the second.
/// Parts are the same if their counts are equal and no vertex moved by more than `most` in world space.
/// Materials are the same if colour, sides and all glTF data are equal. O(n).
std::vector<ItemChange> item_changes(const Scene& a, const Scene& b, double most);

} // namespace facetmill::report
