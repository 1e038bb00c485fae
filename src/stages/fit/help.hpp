#pragma once
// The help and manual texts of fit.

namespace facetmill::help::fit {

inline constexpr const char* about =
    R"(Writes the best-looking glTF file under a size, or the smallest that looks the same.)";

inline constexpr const char* details =
    R"(With budget, the file looks as much like the scene as the size allows.
With look, fit writes the smallest file whose pictures differ from those of the scene by at most this
value.
With both, fit writes the same file as with look, and the run fails if it is larger than the budget.

fit chooses the number of triangles, the size and quality of images, and the bits of positions, normals
and texture coordinates.
It judges each choice by how much it changes rendered pictures.
The pictures show the decoded file from six sides, with textures and light: above the four corners,
from above and from below.
The difference is the root mean square of the differences of all pixels, as a share of the full range.
It covers the pixels of the object, in red, green and blue of sRGB, on a black and a white background.
The similarity is 100 % minus the difference.
Skinned and morphed parts are compared in their pose before any animation plays.
Metalness and roughness are not drawn, so their images get the size and quality of the colour images.

fit makes at most 120 trials for each compression to measure the effect of each choice.
It then writes and renders the best combinations as complete files.
Each trial is a real file in memory.
The budget applies to the written file together with the files that it refers to.
If no choice fits, the run fails (exit 1) and names the smallest size that it reached.

The scene passes on unchanged.
Put clean and optimize before fit, because they make a file smaller without changing how it looks.)";

} // namespace facetmill::help::fit
