#pragma once
// The help and manual texts of measure.

namespace facetmill::help::measure {

inline constexpr const char* about =
    R"(Measures areas, second moments, volume, centroids, inertia, edges, angles and curvature.)";

inline constexpr const char* details =
    R"(The report gives the results for every part and in total, in world space and scene units; angles are
in degrees. The area of a polygon in space is half the length of the sum of the cross products
around it; this holds for concave faces, and for non-planar faces it is the area of their projection
along the mean normal. shell is the surface without thickness; its centroid is weighted by area, and
its inertia about the centroid is that of a thin sheet: for a planar polygon the principal moments
are the smallest and the largest second moment of area and their sum. The table of faces gives the
kind, the signed area and the second moments of every polygon, in the axes of its plane, as in
section: for a polygon in a plane z = constant these are x and y. A planar polygon that intersects
itself has the area, the centroid and the moments of the region that it winds around (the nonzero
rule, as in triangulate and section), where each point counts once; its signed area is negative when
the clockwise part is larger. A polygon that is not planar and intersects itself has the area of
that sum, and no moments. In the volume of a solid, the region of such a face counts as often as the
face winds around it.

solid is the inside of a closed surface, filled with the density: volume, mass, centroid, inertia
about the centroid, principal moments (ascending) with their axes, and radii of gyration. It is null
for open surfaces, and in the total when any part is open.

The turn of an edge is the angle between the normals of its two faces, negative where the surface is
concave. aspect_ratio is that of triangles, as validate has it: 1 for an equilateral triangle. kinds
counts the types of polygon. The mean curvature at a vertex is computed from the turns of its edges,
and the Gaussian curvature from the difference between a full turn and the sum of its angles, both
divided by a third of the area around the vertex; their statistics exclude the boundary. For a
manifold, total_in_turns is the Euler number, whatever its shape.

The mesh passes on unchanged except for the attributes asked for.

Sources: P. Bourke, 'Calculating the area of a 3D polygon' (2000), 'Polygon types' (1993),
'Calculating the area and centroid of a polygon' (1988) and 'Centroid of a 3D shell described by 3
vertex facets'; D. Eberly, 'Polyhedral mass properties' (2002); M. Meyer et al., 'Discrete
differential-geometry operators for triangulated 2-manifolds' (2003).)";

} // namespace facetmill::help::measure
