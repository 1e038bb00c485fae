#pragma once
// The help and manual texts of hull.

namespace facetmill::help::hull {

inline constexpr const char* about = R"(Replaces parts by convex shapes around them, for collisions.)";

inline constexpr const char* details =
    R"(The convex hull is exact: its vertices are points of the part, and all tests use exact predicates.
It is closed, manifold and convex. Point clouds and lines work, too.
Points that no face or line uses do not count.

A flat part gets a flat hull, with a front and a back but no volume (W-HULL-FLAT).
A part whose points are all on a line has no hull (E-HULL).

With max_parts, the stage divides a concave part into at most this many convex shapes.
A grid holds the solid: the cells that the surface touches, and the cells that it encloses.
The stage cuts the part with the most concave hull along a grid plane, until each hull is close to the solid.
It then merges hulls while their common hull is close enough, or while there are too many.
The concavity is the largest distance of a point of the hull from the solid, measured by the grid.
The shapes contain the whole surface. Each piece of a face is in the hull of its own corners. Each hull is a
millionth of the part's diagonal larger, which is more than rounding moves a corner.

With max_vertices, a simpler polytope replaces a hull that has more vertices, and encloses it.
The stage starts from an oriented box and repeatedly cuts off the corner that is farthest from the hull.
A box has one side on a face of the hull. The stage takes the smallest of up to 256 such boxes.
A sphere is the smallest one around the part. The flat faces of its mesh stay outside the sphere.
The report gives the centres, axes, sizes and radii.
Exact predicates then test that all points are inside these shapes. If rounding moved a corner inward, the
shape grows until all points are inside.

Engines recognise collision shapes by name: UCX_NAME_00 in Unreal, NAME-convcolonly in Godot.
With keep: true, the part itself is kept, too.
A shape uses the node of its part. For a box, sphere or capsule, this node must scale all axes equally.
Shapes have no attributes and no materials.

Sources: C. B. Barber, D. P. Dobkin and H. Huhdanpaa, 'The quickhull algorithm for convex hulls' (1996);
B. Gaertner, 'Fast and robust smallest enclosing balls' (1999);
K. Mamou, 'Volumetric hierarchical approximate convex decomposition' (2016);
X. Wei et al., 'Approximate convex decomposition for 3D meshes with collision-aware concavity and tree search'
(2022).)";

} // namespace facetmill::help::hull
