#pragma once
// The help and manual texts of thicken.

namespace facetmill::help::thicken {

inline constexpr const char* about =
    R"(Gives a surface a thickness so that it becomes a closed solid, or turns edges into cylinders.)";

inline constexpr const char* details =
    R"(The stage places a reversed copy of the surface behind it, at the given thickness.
Walls along the boundary edges close the solid.
A closed surface becomes a hollow solid.
A closed component becomes solid if no ball fits into it whose radius is the thickness.
Each vertex moves so that the planes of its faces move by the thickness, as closely as one position
allows.
Flat walls therefore keep their thickness up to their corners.
The option miter_limit limits the movement at sharp corners.
The solid is closed only if the surface is oriented (W-THICKEN-OPEN), so use orient first.
Sheets become separate solids if they meet only at a vertex, or at an edge with more than two faces.
Instances of a mesh with the same rotation and scale are thickened once and share the result.

Flat faces whose triangles would be inverted in their plane are triangulated again, so a ring or a
plate with holes keeps its shape. The result is checked for self-intersections (unless the thickness
is larger than the part), for other faces that are inverted by the offset, including faces that
collapse, and for walls within other walls (W-THICKEN). Faces that only touch are not
self-intersections. The wall thickness is measured from the vertices of the front to the faces of the
back. The report gives all of these. Attributes are kept on both sides, with normals reversed on the
back; walls take the attributes of their edge and have normals of their own.

With self_intersections: resolve, boolean operations rebuild a solid that folds or intersects
itself.
A closed surface gives the volume between itself and its moved copy.
If there is too little room for the thickness, the wall becomes thinner or fills the space.
Cavities and pieces smaller than a cube of the thickness are removed.
An open surface becomes the solid enclosed by its two sides and its walls.

Source: P. Bourke, 'Facets, planes, normals, rendering' (1992), which doubles a surface and replaces
lines by cylinders.)";

} // namespace facetmill::help::thicken
