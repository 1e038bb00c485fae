#pragma once
// The help and manual texts of triangulate.

namespace facetmill::help::triangulate {

inline constexpr const char* about =
    R"(Cuts faces of any kind into triangles, or pairs triangles into quads.)";

inline constexpr const char* details =
    R"(Every face with n corners becomes n - 2 triangles without new points.
A closed surface stays closed.
Convex quads are cut along the shorter diagonal.
Other faces are cut by constrained Delaunay triangulation.
These are convex and concave faces, and faces with holes joined by coincident edges.
Their corners are projected along the coordinate axis nearest to the face's normal.
Non-planar faces are projected in the same way.

Planar faces that intersect themselves are filled by the nonzero rule: triangles cover every point
that the outline winds around.
New vertices are added where edges cross, also to the neighbouring faces.
If the outline winds around points several times and the face has no neighbours, they are covered
once.
If it has neighbours, they are covered as often as the outline winds around them, because the
surface would otherwise be open (W-FANS).
Self-intersecting non-planar faces, and faces without area, are cut as fans (W-FANS).

The report counts the input faces by kind: triangle, quad, convex, concave, complex,
self-intersecting, degenerate.
It also counts non-planar faces and gives the largest deviation from a plane.
Vertices, wedges and their attributes are kept.
Triangles copy the attributes of their face.

Source: P. Bourke, 'Polygon types' (1993).)";

} // namespace facetmill::help::triangulate
