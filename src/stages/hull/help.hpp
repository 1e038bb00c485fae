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
B. Gaertner, 'Fast and robust smallest enclosing balls' (1999).)";

} // namespace facetmill::help::hull
