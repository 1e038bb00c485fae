#pragma once
// The help and manual texts of two-sided.

namespace facetmill::help::two_sided {

inline constexpr const char* about =
    R"(Makes a surface visible from behind, with duplicate faces or through its material.)";

inline constexpr const char* details =
    R"(The option by: faces adds every face once more in reversed order, after all others, with reversed
normals.
Faces that already have a back at the same position stay unchanged.
The back has its own vertices, except along boundary edges, which both sides share.
An open surface becomes a closed surface without volume.
In formats that weld by position (STL, glTF), both sides share all vertices.

The option by: material sets glTF's doubleSided on every material of the parts.
Only glTF can store this.
To give a surface a real thickness, use thicken.

Source: P. Bourke, 'Facets, planes, normals, rendering' (1992).)";

} // namespace facetmill::help::two_sided
