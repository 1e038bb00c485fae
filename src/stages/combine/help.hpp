#pragma once
// The help and manual texts of combine.

namespace facetmill::help::combine {

inline constexpr const char* about =
    R"(Combines solids by boolean operations: union, difference and intersection of parts.)";

inline constexpr const char* details =
    R"(The operation union joins all selected parts and all parts of `with` into one part, which replaces
the first of them.
Without `with`, union joins all parts, or the parts selected by the common key `only`.
The operation difference subtracts the parts of `with` from each other part.
The operation intersection keeps the volume that each other part shares with any part of `with`.
The parts of `with` are removed from the scene unless keep is on.

Each part must be closed and consistently oriented.
E-COMBINE reports the first part that is not; clean and orient can repair it.
A part may intersect itself, have several components, and have cavities.
Its solid is everything that its surface winds around at least once.

Faces are cut exactly where they intersect, even if they are coplanar.
A piece is kept if the result is on exactly one side of it.
Faces deep inside other solids are removed first, because none of their pieces can remain.
New vertices are rounded to floating-point coordinates.
If faces then intersect again, the union is repeated up to eight times.

The result is closed, edge-manifold and free of self-intersections.
Otherwise, the stage fails.
Solids that touch at an edge or a vertex stay separate.
W-COMBINE-NOTHING warns about parts without remaining faces.
W-COMBINE-IDLE warns about parts of `with` that subtract nothing.

Uncut faces stay unchanged.
Cut faces become triangles between their corners and the points where other faces border on them.
Cuts that do not show in the result leave no edges.
Coplanar triangles with matching attributes are triangulated together, so a cut across their
diagonal leaves no vertex.
Attributes match if face attributes are equal and other attributes continue linearly, as texture
coordinates do on a flat quad.

Faces keep their materials.
If faces of two parts coincide, the faces of the first part remain.
New vertices get interpolated attributes from the face that was cut.
Faces of `with` that bound a difference are reversed, with their normals.
If only some parts have an attribute, the others get a default value.
Colours become white, normals become the face normals, and known attributes become zero.
Unknown attributes, such as quality, become nan.

After union, the face attribute group numbers the original parts.
After other operations, cut_id numbers the faces from parts of `with`, and is 0 elsewhere.
Numbering continues after existing numbers, so relax and crumple can keep these faces planar, like
caps.
Their group is 0 unless they were caps, because numbers from two parts could clash.
Parts are combined in the space of the remaining part, which keeps its node.
Skins are removed (W-SKIN).

After Q. Zhou, E. Grinspun, D. Zorin and A. Jacobson, "Mesh arrangements for solid geometry"
(2016).)";

} // namespace facetmill::help::combine
