#pragma once
// The help and manual texts of measure.

namespace facetmill::help::measure {

inline constexpr const char* about =
    R"(Measures areas, second moments, volume, centroids, inertia, edges, angles and curvature.)";

inline constexpr const char* details =
    R"(The report gives results for each part and in total, in world space and scene units.
Angles are in degrees.

The area of a polygon is half the length of the sum of the cross products around it.
This also holds for concave faces.
For non-planar faces, it is the area of their projection along the mean normal.

The result shell describes the surface without thickness.
Its centroid is weighted by area, and its inertia about the centroid is the inertia of a thin sheet.
For a planar polygon, the principal moments are the smallest and largest second moments of area and
their sum.

The table of faces lists the kind, the signed area and the second moments of every polygon.
The moments use the axes of its plane, as in section.
For a plane z = constant, these are x and y.

With per: part, a table has a row for each part. With per: scene, it has a single row.
The overhang is the area of the faces that look down with a slope below overhang_angle.
Faces that lie on the plate, at the lowest point, do not count.
The height is measured along the up axis, or along z if the up axis is unknown.

A planar polygon that intersects itself has the area, centroid and moments of its nonzero winding
region.
Each point counts once, as in triangulate and section.
Its signed area is negative if the clockwise part is larger.
A non-planar polygon that intersects itself has the area of the cross product sum, but no moments.
For the volume of a solid, each region of such a polygon counts as often as the polygon winds around
it.

The result solid describes the inside of a closed surface, filled with the density.
It contains volume, mass, centroid, inertia about the centroid, ascending principal moments with
their axes, and radii of gyration.
It is null for open surfaces.
If shells lie within each other and face outward, the inner ones count as cavities, as after orient.
Shells that pass through each other count as their union (W-SHELLS).
The total is null if any part is open.

The turn of an edge is the angle between the normals of its two faces.
It is negative at concave edges.
The result aspect_ratio applies to triangles, as in validate, and is 1 for an equilateral triangle.
The result kinds counts the types of polygon.

The mean curvature at a vertex is computed from the turns of its edges.
The Gaussian curvature is a full turn minus the angles at the vertex.
Both are divided by a third of the area around the vertex.
Statistics of curvature exclude the boundary.
The result total_in_turns is the Euler number of a manifold, whatever its shape.

A file for robot simulators (.urdf for ROS, .mjcf or .xml for MuJoCo) has a link or body for each part.
The inertia is about the centre of mass, along the axes of the scene, with lengths in metres.
density is then the mass in kg of a cubic scene unit.

The mesh passes on unchanged, except for the requested attributes.

Sources: P. Bourke, 'Calculating the area of a 3D polygon' (2000), 'Polygon types' (1993),
'Calculating the area and centroid of a polygon' (1988) and 'Centroid of a 3D shell described by 3
vertex facets'; D. Eberly, 'Polyhedral mass properties' (2002); M. Meyer et al., 'Discrete
differential-geometry operators for triangulated 2-manifolds' (2003).)";

} // namespace facetmill::help::measure
