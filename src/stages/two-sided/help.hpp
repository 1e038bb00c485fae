#pragma once
// The help and manual texts of two-sided.

namespace facetmill::help::two_sided {

inline constexpr const char* about =
    R"(Makes a surface visible from behind, by duplicate faces or by its material.)";

inline constexpr const char* details =
    R"(With by: faces, every face is added once more in reversed order, after all others, with its normals
reversed; faces that already have a back at the same position are left as they are. The back has its
own vertices, except along boundary edges, which both sides share: an open surface becomes a closed
one without volume. In files that are welded by position (STL, glTF) both sides will share all their
vertices. With by: material, glTF's doubleSided is set on every material of the parts; only glTF can
express this. To give a surface a real thickness, use thicken.

Source: P. Bourke, 'Facets, planes, normals, rendering' (1992).)";

} // namespace facetmill::help::two_sided
