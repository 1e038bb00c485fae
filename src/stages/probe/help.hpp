#pragma once
// The help and manual texts of probe.

namespace facetmill::help::probe {

inline constexpr const char* about =
    R"(Queries points, segments and rays against the surface: inside or outside, closest face, hits.)";

inline constexpr const char* details =
    R"(Each point is inside, outside or on the surface.
The report gives its winding number (how often the surface winds around it), its distance, and the
closest point with part and face.
A point is inside if its winding number is not zero.
This test is exact and counts the crossings of a ray with the faces.
An open surface has no inside (W-PROBE-OPEN), but distances are still measured.

For each segment and ray, the report lists its hits.
Each hit has t (0 to 1 along a segment, the distance along a ray), the point, and the part and face.
It also shows whether the line enters the surface.
Exact signs decide whether a line meets a face.
A line through an edge or a corner counts as moved slightly aside, always in the same direction.
A line therefore crosses a surface exactly once.
A line in the plane of a face does not meet that face.
An end point on the surface counts as a hit.

The scene passes on unchanged.
All values are in world space and scene units.

Sources: P. Bourke, 'Determining whether a line segment intersects a 3 vertex facet' (1997) and
'Determining if a point lies on the interior of a polygon' (1987).)";

} // namespace facetmill::help::probe
