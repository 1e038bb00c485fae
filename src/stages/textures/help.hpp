#pragma once
// The help and manual texts of textures.

namespace facetmill::help::textures {

inline constexpr const char* about = R"(Makes the images of materials smaller, as PNG, JPEG, WebP or KTX2.)";

inline constexpr const char* details =
    R"(Images are scaled down to max_size and power_of_two, never up, by Lanczos's filter: colours in
linear light, weighted by alpha where the material masks or blends; normal maps as directions, which
are of length 1 again; all else (metalness, roughness, occlusion ...) as plain numbers. An image in
several of these roles is treated as numbers, and written with the options of the strictest:
normals, then data. Images of equal bytes are worked on once.

An image that has the size and the format that are asked for stays as it is, byte for byte (unless
repack makes it smaller, with the same pixels: JPEG keeps all else that it says, PNG nothing); so
does one that would not be smaller in the other format (but png is always done), that is broken,
larger than 2^26 pixels or of another kind (KTX2, DDS), that is read pixel by pixel (both filters
NEAREST, as for a palette), or that holds feature ids, metadata or light. A colour image whose alpha
is used does not become JPEG (W-TEXTURE-KEPT). Images of 16 bits a channel that are worked on have 8
afterwards.

ktx2 hands images to the program ktx, or toktx, of KTX-Software, which is looked for in PATH, or which
FACETMILL_KTX names: the only program that facetmill runs. Colours become ETC1S in sRGB, data ETC1S
that is linear, normal maps linear UASTC, each with all its smaller levels; the sides are rounded down to
multiples of 4 pixels. An image that is read as colours and as numbers, and one of fewer than 4 pixels,
stays as it is (W-TEXTURE-KEPT). The bytes depend on the version of the program. KTX2 is named by
KHR_texture_basisu, as WebP is named by its extension.

WebP is named by EXT_texture_webp, which is then required: there is no second image for readers that
do not know it. An image that stands beside another one for such readers is scaled, but does not
become WebP. With only, images that parts left out use, too, stay as they are.

Source: K. Turkowski, 'Filters for Common Resampling Tasks' (1990).)";

} // namespace facetmill::help::textures
