#pragma once
// The help and manual texts of separate.

namespace facetmill::help::separate {

inline constexpr const char* about = R"(Separates parts by component, material or group.)";

inline constexpr const char* details =
    R"(Each result becomes a part of its own, named after the original part and its number, material or
group, in the order of their first faces. Vertices and wedges that several results share are copied,
attributes are kept, and isolated vertices are dropped. The first result keeps the node of the part,
and the others get nodes beside it; all keep its skin and its animation. A part that gives a single
result is left as it is; so is, with `group`, one of several parts that has no attribute `group`,
as in an OBJ file whose groups are parts already.)";

} // namespace facetmill::help::separate
