#pragma once
// The help and manual texts of crop.

namespace facetmill::help::crop {

inline constexpr const char* about = R"(Keeps what lies inside or outside a polygon, seen along an axis.)";

inline constexpr const char* details =
    R"(The footprint is a polygon with holes and islands, in world coordinates across the axis. A point
inside an odd number of its rings is inside, whatever the orientation of the rings; the last point
of a ring may repeat the first. A footprint that intersects itself is refused, with the position.

With by: cut, faces are cut at the outline: each edge that the outline crosses gets one new vertex,
shared by the faces there, so no cracks appear. A face at a corner of the outline is cut into a few
more faces than strictly necessary. With cap, a closed part stays closed: vertical walls stand on
the outline and on its holes, and the walls of the inside and of the outside fit exactly. The face
attribute cut_id numbers the walls by the segments of the outline, and group by its rings. Without
cap, closed parts become open. Positions that are 32-bit floats count as on the outline when they
are within the rounding of one float of the part's bounds, because the 0.1 of an STL is not the 0.1
of a footprint. New vertices and wedges are interpolated, and the new faces copy the attributes of
the face they come from. When whole faces are kept or removed, no attributes are interpolated;
corners on the outline count as on either side. Of a part without faces, a cloud of points, the
points on the kept side stay; those on the outline are inside.

File formats of the footprint: GeoJSON (Polygon, MultiPolygon, and features and collections of
them), WKT (POLYGON, MULTIPOLYGON), and text DXF. In a DXF, circles, ellipses and closed polylines
are rings, and so are lines, arcs, splines and polylines whose ends meet, also in inserted blocks.
Arcs become segments of at most 5 degrees. Lines that enclose nothing are left out with a warning
(W-FOOTPRINT); an outline with a gap is refused. If the drawing states its unit ($INSUNITS), it is
converted to the unit of the scene.

Source: P. Bourke, 'Determining if a point lies on the interior of a polygon' (1987).)";

} // namespace facetmill::help::crop
