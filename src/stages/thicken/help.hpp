#pragma once
// The help and manual texts of thicken.

namespace facetmill::help::thicken {

inline constexpr const char* about =
    R"(Gives a surface a thickness so that it becomes a closed solid, or turns edges into cylinders.)";

inline constexpr const char* details =
    R"(The stage places a reversed copy of the surface behind it, at the given thickness.
Walls along the boundary edges close the solid.
A closed surface becomes a hollow solid.
A closed component becomes solid if no ball with the thickness as its radius fits into it.
Each vertex moves so that the planes of its faces move by the thickness, as closely as one position
allows.
Flat walls therefore keep their thickness up to their corners.
The option miter_limit limits the movement at sharp corners.
The solid is closed only if the surface is oriented (W-THICKEN-OPEN), so use orient first.
Sheets become separate solids if they meet only at a vertex, or at an edge with more than two faces.
Instances of a mesh with the same rotation and scale are thickened once and share the result.

Flat faces are triangulated again if the offset would invert their triangles in their plane.
A ring or a plate with holes therefore keeps its shape.
The stage checks the result for self-intersections, unless the thickness is larger than the part.
Faces that only touch are not self-intersections.
The stage also looks for other faces that the offset inverted or collapsed, and for walls inside
other walls (W-THICKEN).
The report gives these counts and the wall thickness, measured from the front vertices to the back
faces.
Both sides keep their attributes, and the back gets reversed normals.
Walls copy the attributes of their edge and get their own normals.

With self_intersections: resolve, boolean operations rebuild a solid that folds or intersects
itself.
A closed surface gives the volume between itself and its moved copy.
If there is too little room for the thickness, the wall becomes thinner or fills the space.
Cavities and pieces smaller than a cube with the thickness as its side are removed.
An open surface becomes the solid enclosed by its two sides and its walls.

With drain, vertical holes connect each cavity with the outside.
A hole starts at the lowest point of the cavity where a ball of its diameter fits, and passes through
the wall below.
Further holes start at the next lowest points, at least two diameters apart.
Lowest refers to the up axis of the scene, or to +Z if the up axis is unknown.

Source: P. Bourke, 'Facets, planes, normals, rendering' (1992), which doubles a surface and replaces
lines by cylinders.)";

} // namespace facetmill::help::thicken
