#pragma once
// The help and manual texts of hull.

namespace facetmill::help::hull {

inline constexpr const char* about = R"(Replaces parts by convex shapes around them, for collisions.)";

inline constexpr const char* details =
    R"(The convex hull is exact: its vertices are points of the part, and every decision has an exact sign.
It is closed, manifold and convex. Point clouds and lines work, too.
Points that no face or line uses do not count.

A flat part gets a flat hull, with a front and a back and no volume (W-HULL-FLAT).
A part whose points are all on a line has no hull (E-HULL).

With max_vertices, a hull with more vertices becomes a simpler polytope around it.
Its planes cut the corners of an oriented box that are farthest from the hull.
A box has a side on a face of the hull, and is the smallest of up to 256 such boxes.
A sphere is the smallest one. Its mesh lies outside the sphere, so that flat faces enclose the part.
The report has the centres, axes, sizes and radii.
Exact predicates then test that all points are inside these shapes. If rounding moved a corner inward, the
shape grows until they are.

Engines read names: UCX_NAME_00 in Unreal, NAME-convcolonly in Godot. keep: true keeps the drawn part, too.
A shape is placed by the node of its part. Boxes, spheres and capsules need a node that scales all
directions alike.
Shapes have no attributes and no materials.

Sources: C. B. Barber, D. P. Dobkin and H. Huhdanpaa, 'The quickhull algorithm for convex hulls' (1996);
B. Gaertner, 'Fast and robust smallest enclosing balls' (1999).)";

} // namespace facetmill::help::hull
