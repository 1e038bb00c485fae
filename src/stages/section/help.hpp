#pragma once
// The help and manual texts of section.

namespace facetmill::help::section {

inline constexpr const char* about =
    R"(Cuts plane sections: contours with areas, centroids and moments, and drawings to scale.)";

inline constexpr const char* details =
    R"(A plane, or a stack of parallel planes, gives polygons with holes, in a frame that the report
states: its origin is the foot of the world's origin on the plane, u lies along the next axis in the
cyclic order x, y, z after the axis of the normal's largest component, and v is normal x u. Each
contour has its orientation, kind (triangle, quad, convex, concave, complex, self-intersecting),
area, centroid, second moments about the origin and about the centroid, and principal axes, all in
the plane and in world space. The section as a whole has the same measures, with its holes
subtracted (its moments are the integrals of products of coordinates). For a stack, the sum of areas
times spacing is compared with the volume. A plane that misses the mesh gives an empty section,
which is a valid result.

Vertices are classified once, by exact signs. A vertex on the plane counts as above it, so a section
is the one just below the plane: for a cube standing on z = 0, the section at the bottom is empty
and the section at the top is a square.

A region is inside if its winding number is not zero, whatever the direction (the nonzero rule,
which also fills drawings and hatching). So bodies that overlap are one region, as in space; the
even-odd rule would leave a hole. A contour that intersects itself has the area and the moments of
all regions that it winds around (W-SECTION-CROSSES). Outlines of a mesh that is inside out run
clockwise and have negative areas (W-INSIDE-OUT).

Drawings are SVG (sections side by side), DXF (one layer per section) and JSON (all points and
measures). The scene passes on unchanged.

Sources: P. Bourke, 'Polygon types' (1993), 'Determining whether or not a polygon (2D) has its
vertices ordered clockwise or counter-clockwise' (1998), 'Calculating the area and centroid of a
polygon' (1988) and 'Clipping a line segment to a complex polygon' (1997) for hatch.)";

} // namespace facetmill::help::section
