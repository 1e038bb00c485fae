#pragma once
// The help and manual texts of merge.

namespace facetmill::help::merge {

inline constexpr const char* about = R"(Joins parts into a single part.)";

inline constexpr const char* details =
    R"(The parts (all parts, or those selected by the key `only`) become one mesh in world space, in the
place of the first. Materials stay with their faces. Where an attribute exists only in some parts,
the others get white (colours), the normal of the face, no number (nan, where attributes have no
meaning to facetmill, such as quality), or zero; in glTF they are written without it. The face
attribute `group` numbers the original parts, so `separate: group` separates them
again. Nodes and skins of the parts are dropped. Parts that merging would show differently stay as they
are: animated and instanced parts, levels of detail, and parts that viewers do not show. Closedness is a property of a part:
solids that only touch form one closed part, and with weld they share vertices.)";

} // namespace facetmill::help::merge
