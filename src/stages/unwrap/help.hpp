#pragma once
// The help and manual texts of unwrap.

namespace facetmill::help::unwrap {

inline constexpr const char* about = R"(Makes texture coordinates: flat charts, packed into one square.)";

inline constexpr const char* details =
    R"(The surface is divided into charts along features and curvature. Each chart is flattened as rigidly as
possible. Neighbouring charts are joined while the stretch of the result is at most max_stretch.
All selected parts share one square, so a single texture can hold them all.

The stretch is the L2 stretch of Sander and others: the root of the mean of (G^2 + g^2) / 2, where G and g are
the largest and the smallest growth of lengths from the texture to the surface. 1 means no stretch.
Texels are equally dense on all charts, measured in the world.

Exact tests check the result: every face is in one chart and has an area, no chart is mirrored, and charts
overlap neither themselves nor each other. At least gutter empty texels separate two charts.
A chart is a disk, or a disk with holes.

The coordinates become TEXCOORD_0, or the given set. They replace this set, or move it up with keep.
Vertices on seams get several attribute tuples. Normals, colours, weights, materials and groups stay.
Tangents are dropped, because they depend on texture coordinates: use normals: {tangents: 0} after it.
Faces with more than three corners become triangles.

Edges with three or more faces end charts, and so do vertices that are not joined. Use clean first if a scan
or an STL falls into many components. Faces without area get a small area in the texture.

Sources: D. Cohen-Steiner, P. Alliez and M. Desbrun, 'Variational shape approximation' (2004).
L. Liu and others, 'A local/global approach to mesh parameterization' (2008).
P. V. Sander and others, 'Texture mapping progressive meshes' (2001).
O. Sorkine and others, 'Bounded-distortion piecewise mesh parameterization' (2002).)";

} // namespace facetmill::help::unwrap
