#pragma once
// The help and manual texts of crop.

namespace facetmill::help::crop {

inline constexpr const char* about = R"(Keeps the inside or the outside of a polygon, seen along an axis.)";

inline constexpr const char* details =
    R"(The footprint is a polygon with holes and islands, in world coordinates perpendicular to the axis.
A point is inside if an odd number of rings contain it, whatever their orientation.
The last point of a ring may repeat the first.
A footprint that intersects itself is refused, and the message gives the position.

With by: cut, faces are cut at the outline.
Each edge that crosses the outline gets one new vertex, shared by its faces, so no cracks appear.
A face at a corner of the outline is cut into slightly more faces than necessary.

With cap, closed parts stay closed.
Vertical walls follow the outline and its holes, and the walls of the inside and the outside match
exactly.
The face attribute cut_id numbers the walls by segment, and group numbers them by ring.
Without cap, closed parts become open.

32-bit float positions count as on the outline if their rounding error explains the distance.
This matters because 0.1 in an STL file differs slightly from 0.1 in a footprint.
New vertices and wedges are interpolated, and new faces copy the attributes of their original face.
When whole faces are kept or removed, no attributes are interpolated, and corners on the outline
count as on both sides.
In a point cloud, points on the kept side stay, and points on the outline count as inside.

The footprint may be a GeoJSON, WKT or text DXF file.
GeoJSON may contain Polygon, MultiPolygon, features and collections.
WKT may contain POLYGON and MULTIPOLYGON.
In a DXF, circles, ellipses and closed polylines are rings.
Lines, arcs, splines and polylines also form rings if their ends meet, even in inserted blocks.
Arcs become segments of at most 5 degrees.
Lines that enclose nothing are skipped with a warning (W-FOOTPRINT).
An outline with a gap is refused.
If the drawing gives its unit ($INSUNITS), it is converted to the unit of the scene.

Source: P. Bourke, 'Determining if a point lies on the interior of a polygon' (1987).)";

} // namespace facetmill::help::crop
