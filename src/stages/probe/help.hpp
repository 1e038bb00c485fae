#pragma once
// The help and manual texts of probe.

namespace facetmill::help::probe {

inline constexpr const char* about =
    R"(Queries points, segments and rays against the surface: inside or outside, closest face, hits.)";

inline constexpr const char* details =
    R"(A point is inside, outside or on the surface, and has a winding number (how often the surface winds
around it), a distance, and the closest point with its part and face. A point is inside where the
winding number is not zero; this is decided exactly, by the crossings of a ray with the faces. An
open surface has no inside (W-PROBE-OPEN), but distances are still measured.

Segments and rays have hits: t (0 to 1 along a segment, the distance along a ray), the point, the
part and face, and whether the line enters the surface there. Exact signs decide whether a line
meets a face. A line through an edge or a corner is treated as if moved slightly aside, always in
the same direction, so a surface that is crossed is crossed exactly once; a line within the plane of
a face does not meet that face. An end point on the surface counts as a hit.

The scene passes on unchanged. Everything is in world space and scene units.

Sources: P. Bourke, 'Determining whether a line segment intersects a 3 vertex facet' (1997) and
'Determining if a point lies on the interior of a polygon' (1987).)";

} // namespace facetmill::help::probe
