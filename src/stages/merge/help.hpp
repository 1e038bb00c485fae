#pragma once
// The help and manual texts of merge.

namespace facetmill::help::merge {

inline constexpr const char* about = R"(Joins parts into a single part.)";

inline constexpr const char* details =
    R"(The selected parts (all parts, unless you give the common key `only`) become one mesh in world
space.
The mesh replaces the first of them.
Faces keep their materials.
If only some parts have an attribute, the others get a default value.
Colours become white, normals become the face normals, and known attributes become zero.
Unknown attributes, such as quality, become nan.
In glTF, the parts that lacked an attribute are written without it.
The face attribute `group` numbers the original parts, so `separate: group` can undo the merge.
Nodes and skins are removed.
Parts that would look different after merging stay unchanged (W-MERGE-STAYS).
These are animated and instanced parts, levels of detail, and parts that viewers do not show.
With attributes: none, only the surface remains, without `group`.
Solids that only touch form one closed part.
With weld they also share vertices.)";

} // namespace facetmill::help::merge
