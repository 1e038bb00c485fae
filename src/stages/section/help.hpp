#pragma once
// The help and manual texts of section.

namespace facetmill::help::section {

inline constexpr const char* about =
    R"(Cuts plane sections: contours with areas, centroids and moments, and drawings to scale.)";

inline constexpr const char* details =
    R"(A plane or a stack of parallel planes gives polygons with holes.
The report gives them in a 2D frame.
The origin of the frame is the point of the plane nearest to the world origin.
The normal's largest component selects the u axis: u follows the next world axis in the cyclic order x, y, z.
The v axis is normal x u.

Each contour has an orientation, a kind (triangle, quad, convex, concave, complex,
self-intersecting), an area and a centroid.
It also has second moments about the origin and the centroid, and principal axes.
All of these are given in the plane and in world space.
The whole section has the same measures, with holes subtracted.
Its moments are integrals of products of coordinates.
For a stack, the report compares the sum of areas times spacing with the volume.
A plane that misses the mesh gives an empty section, which is a valid result.

Each vertex is classified once, by exact signs.
A vertex on the plane counts as above it, so the section is taken just below the plane.
For a cube that rests on z = 0, the section at the bottom is empty and the section at the top is a
square.

A region is inside if its winding number is not zero, whatever the direction (the nonzero rule).
Drawings and hatching use the same rule.
Overlapping bodies therefore form one region, while the even-odd rule would leave a hole.
The area and the moments of a self-intersecting contour include all regions that it winds around
(W-SECTION-CROSSES).
If the mesh is inside out, outlines run clockwise and have negative areas (W-INSIDE-OUT).

Drawings are SVG, DXF (one layer per section), GeoJSON (lines in world coordinates) and JSON (all points and
measures).
With layout: sheets, an SVG shows the sections next to each other.
With layout: contours, the sections lie over each other as in a map.
Their heights become labels and layer names.
Without a plane, the heights are multiples of the spacing.
With layout: profile, the chainage starts at 0 and runs toward +x or +y, whichever is nearer.
Elevations are absolute.
Both of these layouts draw lines without an inside, so an open terrain gives no warning.
A GeoJSON file has one feature per line.
Its properties are the part, the height above the first plane, and the elevation if the plane is level.
If y is up, maps show x and -z, and GeoJSON files store x and z, as for crop.
The scene passes on unchanged.

Sources: P. Bourke, 'Polygon types' (1993), 'Determining whether or not a polygon (2D) has its
vertices ordered clockwise or counter-clockwise' (1998), 'Calculating the area and centroid of a
polygon' (1988) and 'Clipping a line segment to a complex polygon' (1997) for hatch.)";

} // namespace facetmill::help::section
