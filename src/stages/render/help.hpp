#pragma once
// The help and manual texts of render.

namespace facetmill::help::render {

inline constexpr const char* about =
    R"(Renders a PNG image, with textures, by attribute, from several sides.)";

inline constexpr const char* details =
    R"(The stage draws the selected parts (all parts, unless you give the common key `only`) as large as
possible.
It takes four samples per pixel.

Materials are drawn as in glTF: base colour, normal, emissive and occlusion textures (PNG, JPEG,
WebP) with wrap, filter and KHR_texture_transform.
Alpha masks and blending, vertex colours and KHR_materials_unlit are supported.
Colours are mixed in linear light.
Metalness and roughness are ignored because there is no environment map.
If a texture is missing, broken or larger than 2^26 pixels, the plain colour of the material is
drawn (W-TEXTURE).

Skinned parts are drawn in the pose that their joint nodes define, and morphed parts with their
default weights.
Viewers show the same before an animation plays.
Other stages use the bind pose.

The front faces +z if y points up (glTF), and -y if z points up.
If the up axis is unknown, the scene is placed on its flat base, if it has one.
Otherwise, z is up if the scene is longest along z, and y is up if not.
The picture of an open surface then shows the front of its faces.

An attribute that no part has is measured in bind pose and world space.
The legend shows the unit of the scene.
To store such values, use measure: {attributes: ...}.

The attribute deviation is measured from the mesh given by with, or from the scene as loaded.
The colours of that mesh show its own distance from the scene.
Large faces are also measured inside, unless their edges are drawn (edges: all).
Signed numbers (deviation, curvatures) are blue below 0 and red above, on a symmetric scale.
Faces without a number, such as the thickness of a sheet, are pink.

The light comes from the upper left of the viewer.
The option `shading: one-sided` uses the cosine of the angle between the normal of a face and the
light, so reversed faces are dark.
With `absolute`, it is the absolute value, which hides reversed faces.
The option `shading: beside` shows both images.
Faces that differ between them are reversed: use orient, or two-sided.
By default, inner sides are orange, so holes and reversed faces are easy to see.
The scene passes on unchanged.
The image is byte for byte the same for any number of threads and on any processor.

Sources: P. Bourke, 'Facets, planes, normals, rendering' (1992); M. McGuire, M. Mara and D. Luebke,
'Scalable Ambient Obscurance' (2012), for occlusion; S. van der Walt and N. Smith, 'viridis' (2015).)";

} // namespace facetmill::help::render
