#pragma once
// The help and manual texts of clip.

namespace facetmill::help::clip {

inline constexpr const char* about = R"(Clips parts by planes or boxes, with watertight caps.)";

inline constexpr const char* details =
    R"(Every vertex is classified once, by the exact sign of its distance, so neighbouring faces always
agree, and a vertex on the plane is neither in front of it nor behind it. Each cut edge gets one new
vertex, shared by all faces at that edge. Triangles, quads and larger faces, convex or concave, are
cut directly. A closed part that is capped stays closed in every case: after several planes in a
row, when it is non-manifold, and when it intersects itself (where it covers a region twice, so does
its cap). Where the kept part touches a plane only at a vertex or an edge, the cap has it as a corner
or an edge, and a manifold part is separated there. Points that a clip placed on a plane count as lying on it when the same plane is used
again, in this stage or a later one, until a stage moves them. Of a part without faces, a cloud of
points, the points on the kept side stay; those on a plane are in front of it.

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
