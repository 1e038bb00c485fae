#pragma once
// What the help and the manual say about measure.

namespace facetmill::help::measure {

inline constexpr const char* about =
    R"(Measures areas, second moments, volume, centroids, inertia, edges, angles and curvature.)";

inline constexpr const char* details =
    R"(The report gives the results for every part and in total, in world space and scene units; angles are
in degrees. The area of a polygon in space is half the length of the sum of the cross products
around it; this holds for concave faces, and for non-planar faces it is the area of their projection
along the mean normal. shell is the surface without thickness; its centroid is weighted by area, and
its inertia about the centroid is that of a sheet: for a planar polygon the principal moments are the
smallest and the largest second moment of area and their sum. The table of faces has the kind, the
signed area and the second moments of every polygon, in the plane's own axes as section has them: for
a polygon in a plane z = constant they are x and y. A planar polygon that intersects itself has the
area, the centroid and the moments of all that it winds around (the nonzero rule, as in triangulate and
section), each point counted once; its signed area is negative when more of it is wound around
clockwise. One that is not planar has the area of the sum, and no moments. The volume of a solid
counts what such faces wind around as often as they do.
solid is the inside of a closed surface, filled with the density: volume, mass, centroid, inertia
about the centroid, principal moments (ascending) with their axes, and radii of gyration. It is null
for open surfaces, and in the total when any part is open.

The turn of an edge is the angle between the normals of its two faces, negative where the surface is
concave. aspect_ratio is that of triangles, as validate has it: 1 for an equilateral triangle. kinds
counts the types of polygon. The mean curvature at a vertex comes from the turns of its edges, and
the Gaussian curvature from what its angles lack of a full turn, both divided by a third of the area
around the vertex; their statistics leave out the boundary. For a manifold, total_in_turns is the
Euler number, whatever its shape.

The mesh passes on unchanged except for the attributes asked for.

Sources: P. Bourke, 'Calculating the area of a 3D polygon' (2000), 'Polygon types' (1993), 'Calculating the
area and centroid of a polygon' (1988) and 'Centroid of a 3D shell described by 3 vertex facets'; D. Eberly, 'Polyhedral mass properties'
(2002); M. Meyer et al., 'Discrete differential-geometry operators for triangulated 2-manifolds'
(2003).)";

} // namespace facetmill::help::measure
