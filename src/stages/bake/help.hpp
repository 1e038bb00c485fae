#pragma once
// The help and manual texts of bake.

namespace facetmill::help::bake {

inline constexpr const char* about =
    R"(Bakes colours, normals and occlusion of the loaded scene into textures.)";

inline constexpr const char* details =
    R"(The surface needs texture coordinates in the unit square, without overlaps: use unwrap before.
By default, the values come from the scene as loaded, before any stage changed it.
With from, they come from another file, which must be in the same place.
All parts share one material with one set of maps:

- base colour: colours, textures and vertex colours of the source, and its alpha
- normal: in the tangent space of MikkTSpace; smooth normals of the source with its normal maps
- occlusion, roughness and metalness in red, green and blue, as in glTF
- emission, if the source glows

Each texel casts a ray along the smooth normal to both sides, and takes the nearest hit.
Its face must look in the same direction, unless facing is any or the source is double-sided.
The rays reach as far as the surfaces are apart, which bake measures, or as far as distance says.
A texel whose ray hits nothing takes the nearest point of the source; the report counts these (missed_texels).
Faces without a material and colours become grey.
Colours are averaged in linear light, and textures are filtered by the size of a texel.
dilation grows the border of each chart, so that smaller levels of the texture show no seams.

Occlusion comes from the occlusion textures of the source, otherwise from rays to the sky.
height, position and thickness are written as PNG files of 16 bits. The report has their ranges.

The surface gets smooth normals if it has none, and new tangents.
Its vertex colours and materials are replaced.
Skinned parts are baked in bind pose.

Sources: P. Cignoni, C. Montani, C. Rocchini and R. Scopigno, 'A general method for preserving attribute
values on simplified meshes' (1998); M. S. Mikkelsen, 'Simulation of Wrinkled Surfaces Revisited' (2008).)";

} // namespace facetmill::help::bake
