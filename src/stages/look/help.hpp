#pragma once
// The help and manual texts of look.

namespace facetmill::help::look {

inline constexpr const char* about = R"(Compares pictures of the scene with pictures of the loaded scene.)";

inline constexpr const char* details =
    R"(The pictures show both scenes from eight sides, with textures and light: above and below the four
corners.
The difference is the root mean square of the differences of all pixels, as a share of the full range.
It covers the pixels of either object, in red, green and blue of sRGB, on a black and a white background.
The run fails if it is larger than max.

The structural similarity compares the brightness in windows of 8 x 8 pixels. 1 means equal pictures.
With path, a PNG gets a row for each side: the loaded scene, the current scene, and four times their
difference.
Metalness and roughness are not drawn.
Skinned and morphed parts are compared in their pose before any animation plays.

Source: Z. Wang, A. Bovik, H. Sheikh and E. Simoncelli, 'Image Quality Assessment: From Error Visibility to
Structural Similarity' (2004).)";

} // namespace facetmill::help::look
