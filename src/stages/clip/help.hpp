#pragma once
// The help and manual texts of clip.

namespace facetmill::help::clip {

inline constexpr const char* about = R"(Clips parts by planes or boxes, with watertight caps.)";

inline constexpr const char* details =
    R"(Each vertex is classified once by the exact sign of its distance, so neighbouring faces always
agree.
A vertex on the plane is neither in front nor behind.
Each cut edge gets one new vertex, shared by all faces at that edge.
Triangles, quads and larger faces, convex or concave, are cut directly.
A capped closed part always stays closed, even after several planes, when it is non-manifold, or
when it intersects itself.
If the part covers a region twice, so does its cap.
If the kept side touches a plane only at a vertex or an edge, this becomes a corner or an edge of the
cap.
A manifold part is separated at these places, unless it intersects itself in the plane.
If one clip places a point on a plane, later clips treat it as on that plane, until a stage moves
it.
In a point cloud, points on the kept side stay, and points on a plane count as in front.

Planes are in world space, so node transforms of parts are respected.
A face of a closed part that lies in the plane is kept only if it faces away from the kept side.
An open contour cannot be capped and is reported (W-CAP-OPEN).
All other contours are capped.
Planes that miss every part are reported (W-CLIP-ALL, W-CLIP-NOTHING).
A part without remaining faces stays in the scene as an empty part.

A box keeps its inside, or everything around it with keep: outside.
The two results fit together exactly, and caps close both.
The same holds for several planes with keep: both.
With keep: back alone, the stage keeps the region behind every plane.

New vertices and wedges are interpolated once per edge and pair of wedges, so seams are preserved.
New faces copy the attributes of their original face.
Caps have their own primitive and material and the normal of the plane.
They get planar texture coordinates if the part has TEXCOORD_0, and zeros in other face attributes.
The face attributes cut_id and group identify the caps.
The number in cut_id is the number of the plane, and 0 elsewhere.

Source: P. Bourke, 'Clipping Polygonal Facets with an Arbitrary Plane' (1997).)";

} // namespace facetmill::help::clip
