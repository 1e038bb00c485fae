#pragma once
// The help and manual texts of render.

namespace facetmill::help::render {

inline constexpr const char* about =
    R"(Renders a PNG image, with textures, by attribute, from several sides.)";

inline constexpr const char* details =
    R"(The selected parts (all parts, or those selected by the key `only`) are drawn as large as possible,
with four samples per pixel. Materials are drawn as glTF has them: base colour, normal, emissive and
occlusion textures (PNG, JPEG, WebP) with wrap, filter and KHR_texture_transform, alpha masks and
blending, vertex colours, KHR_materials_unlit; colours are mixed in linear light. Metalness and
roughness are ignored, because there is no environment map. Where a texture cannot be drawn
(missing, broken, more than 2^26 pixels), the plain colour is drawn, with a warning (W-TEXTURE).
Skinned parts are drawn as the nodes place their joints, and morphed parts by their default weights,
as viewers show them before anything plays; other stages work on the bind pose.

The front is towards +z if y points up (glTF), and towards -y if z does. If the file does not say
which axis is up, the scene stands on its flat base, if it has one; otherwise z is taken as up if
the scene is longest along it, and y if not. An open surface is then seen from the side that its
faces face.

An attribute that no part has is measured: in bind pose, in world space, with the unit of the scene
on the legend (measure: {attributes: ...} keeps it instead). deviation is measured from the other
mesh (with), whose own colours show how far it is from the scene, or else from the scene as loaded;
large faces are measured inside, too, unless their edges are drawn (edges: all). Signed numbers
(deviation, curvatures) are blue below 0 and red above, on a scale that is as wide either way; where
there is no number, such as the thickness of a sheet, faces are pink.

The light comes from the upper left of the viewer. `shading: one-sided` takes the cosine of the
angle between the normal of a face and the light, so faces with reversed vertex order are dark.
`absolute` uses its absolute value, which hides reversed faces. `beside` shows both images; where
they differ, a face is reversed (use orient) or the surface needs the stage two-sided. By default,
inner sides are orange, so holes and reversed faces are easy to see. The scene passes on unchanged.
The image is the same, byte for byte, on any number of threads and any processor.

Sources: P. Bourke, 'Facets, planes, normals, rendering' (1992); M. McGuire, M. Mara and D. Luebke,
'Scalable Ambient Obscurance' (2012), for occlusion; S. van der Walt and N. Smith, 'viridis' (2015).)";

} // namespace facetmill::help::render
