#pragma once
// The help and manual texts of separate.

namespace facetmill::help::separate {

inline constexpr const char* about = R"(Separates parts by component, material or group.)";

inline constexpr const char* details =
    R"(Each result becomes a part.
Its name combines the name of the original part and a number, material or group.
Results are in the order of their first faces.
Shared vertices and wedges are copied.
Attributes are kept, and isolated vertices are removed.
The first result keeps the node of the part, and the others get new nodes next to it.
All keep its skin and animation.

A part with a single result is left unchanged.
With `group`, a part without the attribute `group` is also left unchanged, if other parts have it.
This happens with OBJ files whose groups are already parts.)";

} // namespace facetmill::help::separate
