#pragma once
// The help and manual texts of triangulate.

namespace facetmill::help::triangulate {

inline constexpr const char* about =
    R"(Cuts faces of any kind into triangles, or pairs triangles into quads.)";

inline constexpr const char* details =
    R"(Every face of n corners becomes n - 2 triangles without new points; a closed surface stays closed.
Convex quads are cut along the shorter diagonal. Convex and concave faces, and faces with holes
joined by coincident edges, are cut by constrained Delaunay triangulation of their corners,
projected along the coordinate axis nearest to the face's normal; non-planar faces are projected in
the same way. Planar faces that intersect themselves are filled by the nonzero rule: triangles cover
each point that the outline winds around. Where edges cross, new vertices are added, also to the
neighbouring faces. Points that the outline winds around several times are covered once if the face
has no neighbours, and otherwise as many times, because the surface would be open if they were
covered once (W-FANS). Self-intersecting faces that are not planar, and faces without area, are cut
as fans (W-FANS).

The report counts the input faces by kind (triangle, quad, convex, concave, complex,
self-intersecting, degenerate) and the non-planar ones, with the largest deviation from a plane.
Vertices, wedges and their attributes are kept; face attributes are copied.

Source: P. Bourke, 'Polygon types' (1993).)";

} // namespace facetmill::help::triangulate
