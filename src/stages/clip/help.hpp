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

Planes are given in world space; parts with a node transform are cut where they stand. A face of a
closed part that lies in the plane is kept only when it faces away from what is kept. A contour that
is not closed cannot be capped: it is reported (W-CAP-OPEN), and the others are capped. Planes
that miss every part are reported (W-CLIP-ALL, W-CLIP-NOTHING); a part of which nothing is kept stays
as an empty part.

A box keeps what is inside it or, with keep: outside, what is around it; the two results fit
together exactly, and with caps both are closed. The same holds for several planes with keep: both;
keep: back alone keeps what is behind each of them.

New vertices and wedges are interpolated, once per edge and pair of wedges, so seams stay seams; the
new faces copy the attributes of the face they come from. Caps have a primitive and a material of
their own, the normal of the plane, planar texture coordinates when the part has TEXCOORD_0, and
zeros in other face attributes. The face attributes cut_id (the number of the plane; 0 elsewhere)
and group identify the caps.

Source: P. Bourke, 'Clipping Polygonal Facets with an Arbitrary Plane' (1997).)";

} // namespace facetmill::help::clip
