#pragma once
// The help and manual texts of fit.

namespace facetmill::help::fit {

inline constexpr const char* about =
    R"(Writes the best-looking glTF file under a size, or the smallest that looks the same.)";

inline constexpr const char* details =
    R"(With budget, the file looks as much like the scene as the size allows.
With look, it is the smallest file whose pictures differ by no more.
With both, it is that smallest file, and the run fails if it is larger than the budget.

It chooses the number of triangles, the size and quality of images, and the bits of positions,
normals and texture coordinates.
It weighs each of them by its change of rendered pictures.
The pictures show the decoded file from six sides, with textures and light: above the four corners,
from above and from below.
Their difference is the root mean square over the pixels of the object, over red, green and blue in
sRGB, on black and on white, as a share of the full range.
The similarity is 100 % less the difference.
Skinned and morphed parts are compared as before any animation plays.
Metalness and roughness are not drawn, so their images get the size and quality of the colours.

At most 120 trials for each compression measure the effect of each choice, and the best combinations are written and
rendered as a whole.
Each trial is a real file in memory, and the limit applies to the written file with its neighbours.
If no choice fits, the run fails (exit 1) and names the smallest size that it reached.

The scene passes on unchanged.
Put clean and optimize before fit, because they make a file smaller without a change of its look.)";

} // namespace facetmill::help::fit
