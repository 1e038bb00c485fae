#pragma once
// The help and manual texts of thicken.

namespace facetmill::help::thicken {

inline constexpr const char* about =
    R"(Gives a surface a thickness, which makes it a closed solid, or turns its edges into cylinders.)";

inline constexpr const char* details =
    R"(A reversed copy of the surface is placed behind it, at the given thickness, and walls close the
boundary edges. A closed surface becomes a hollow solid; a closed component into which no ball with
the thickness as radius fits is filled instead. Every vertex moves so that the planes of its faces
move by the thickness, as closely as a single position permits: flat walls keep their thickness up
to their corners. miter_limit limits the move at sharp corners. The solid is closed only if the
surface is oriented (W-THICKEN-OPEN; use orient). Sheets that meet at an edge with more than two
faces, or only at a vertex, become separate solids. Parts with the same mesh, rotation and scale
(instances) become a solid once and get the same result.

Flat faces whose triangles would be inverted in their plane are triangulated again, so a ring or a
plate with holes keeps its shape. The result is checked for self-intersections (unless the thickness
is larger than the part), for other faces that are inverted by the offset, including faces that
collapse, and for walls within other walls (W-THICKEN). Faces that only touch are not
self-intersections. The wall thickness is measured from the vertices of the front to the faces of the
back. The report gives all of these. Attributes are kept on both sides, with normals reversed on the
back; walls take the attributes of their edge and have normals of their own.

With self_intersections: resolve, a solid that folds over or intersects itself is made again by
boolean operations (as in combine): what the surface encloses, without what its moved copy does.
Where there is no room for the thickness, the wall is thinner or fills the space behind it; cavities
and pieces of less than a cube of the thickness are left out. An open surface becomes the solid that
its two sides and walls wind around.

Source: P. Bourke, 'Facets, planes, normals, rendering' (1992), which doubles a surface and replaces
lines by cylinders.)";

} // namespace facetmill::help::thicken
