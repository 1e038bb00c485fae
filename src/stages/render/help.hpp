#pragma once
// What the help and the manual say about render.

namespace facetmill::help::render {

inline constexpr const char* about =
    R"(Renders a PNG image, shaded by the angle between each face and the light.)";

inline constexpr const char* details =
    R"(The selected parts (all, or those that `only` names) are drawn as large as possible, in parallel
projection, with one shade per face and four samples per pixel. The light comes from the upper left
of the viewer. `shading: one-sided` takes the cosine of the angle between the normal of a face and
the light, so faces with reversed vertex order are dark. `absolute` takes its absolute value, which
hides that. `beside` shows both; where they differ, a face is reversed (use orient) or the surface
needs two-sided. By default, inner sides are orange, so holes and reversed faces are easy to see.
The scene passes on unchanged. The image is the same, byte for byte, on any number of threads.

Source: P. Bourke, 'Facets, planes, normals, rendering' (1992).)";

} // namespace facetmill::help::render
