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

File formats of the footprint: GeoJSON (Polygon, MultiPolygon, and features and collections of
them), WKT (POLYGON, MULTIPOLYGON), and text DXF. In a DXF, circles, ellipses and closed polylines
are rings, and so are lines, arcs, splines and polylines whose ends meet, also in inserted blocks.
Arcs become segments of at most 5 degrees. Lines that enclose nothing are left out with a warning
(W-FOOTPRINT); an outline with a gap is refused. If the drawing states its unit ($INSUNITS), it is
converted to the unit of the scene.

Source: P. Bourke, 'Determining if a point lies on the interior of a polygon' (1987).)";

} // namespace facetmill::help::crop
