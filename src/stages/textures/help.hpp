#pragma once
// The help and manual texts of textures.

namespace facetmill::help::textures {

inline constexpr const char* about =
    R"(Shrinks textures, converts them to PNG, JPEG, WebP, AVIF or KTX2, or merges them into atlases.)";

inline constexpr const char* details =
    R"(Images are scaled down to max_size and power_of_two, never up, with Lanczos's filter.
Colours are scaled in linear light, weighted by alpha if the material masks or blends.
Normal maps are scaled as directions, and their length becomes 1 again.
All other images (metalness, roughness, occlusion ...) are scaled as plain numbers.
An image with several roles is scaled as numbers.
It uses the options for normals if it has that role, otherwise the options for data.
Equal images are processed once.

An image with the requested size and format stays byte for byte the same.
With repack, PNG and JPEG images are repacked if that makes them smaller.
The pixels stay the same.
PNG loses its metadata, JPEG keeps it.

Other images also stay unchanged.
An image stays unchanged if it would not become smaller in the new format (except with png).
It stays unchanged if it is broken, larger than 2^26 pixels, or of another kind (KTX2, DDS).
It stays unchanged if it is read pixel by pixel (both filters NEAREST, as for a palette).
It also stays unchanged if it contains feature ids, metadata or light.
A colour image with used alpha does not become JPEG (W-TEXTURE-KEPT).
Images with 16 bits per channel get 8 bits when they are processed.

The format ktx2 uses the program ktx or toktx of KTX-Software, the only external program that
facetmill runs.
Give its path in FACETMILL_KTX if it is not in PATH.
Colours become ETC1S in sRGB, data becomes linear ETC1S, and normal maps become linear UASTC, each
with all mipmap levels.
Sides are rounded down to multiples of 4 pixels.
An image used both as colours and as numbers stays unchanged, and so does an image with a side below
4 pixels (W-TEXTURE-KEPT).
The bytes depend on the version of the program.
AVIF needs a build with libavif, and its bytes depend on the version of libavif and libaom.
Files refer to KTX2 images through KHR_texture_basisu.

Files refer to WebP images through EXT_texture_webp, and to AVIF images through EXT_texture_avif.
The extension becomes required, because there is no second image for readers without it.
An image that is already the fallback for such readers is scaled, but does not become WebP or AVIF.
With the common key `only`, images that unselected parts also use stay unchanged.

With atlas, materials merge if they have the same kinds of textures, alpha mode, sides, filter and
extensions.
Matching materials without textures become small patches.
Use optimize afterwards: it joins parts with the same material, which saves draw calls.
The atlas holds only the used part of each texture, in a gutter that continues the texture.
Texels keep their values, unless the texture is scaled or the factors of the materials differ.
Different factors are multiplied into the texels, in linear light.
Maps with fewer pixels than others stay smaller, and constant maps shrink to a few pixels.
Repeated and mirrored textures are unrolled, and texture transforms are applied.
If the atlas would be larger than max_size, textures are halved, the one with the most texels per area first.
If all textures of a map are JPEG, or all are WebP, the atlas has that format too.
It is encoded again with quality.
Occlusion, roughness and metalness share an image.
The report lists each material that was not merged, with the reason.
Reasons are more repeats than unroll, different texture coordinates, animation, variants and textures of
extensions.

Source: K. Turkowski, 'Filters for Common Resampling Tasks' (1990).)";

} // namespace facetmill::help::textures
