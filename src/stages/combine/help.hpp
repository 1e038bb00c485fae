#pragma once
// The help and manual texts of combine.

namespace facetmill::help::combine {

inline constexpr const char* about =
    R"(Boolean operations on solids: union, difference and intersection of parts.)";

inline constexpr const char* details =
    R"(union makes one part of all parts selected and those of `with`, in the place of the first.
difference takes the parts of `with` away from each of the others; intersection keeps of each of
the others what lies in a part of `with`. The parts of `with` are removed from the scene, unless
keep is on. Without `with`, union takes all parts (or those selected by the key `only`).

Each part must be closed and consistently oriented (E-COMBINE names the first that is not; clean
and orient repair). It may pass through itself, consist of several components, and have cavities:
its solid is what its surface winds around at least once. Faces are cut along each other exactly,
also where they lie in one plane, and a piece stays where it has the result on one side only; what
lies deep in other solids, where no piece can stay, is left out before. New
vertices are rounded to floating-point coordinates; where that makes faces intersect again, they
are united again, up to eight times. The result is closed, edge-manifold and without
self-intersections, or the stage fails: solids that touch at an edge or a vertex are separate
there. A part of which nothing remains has no faces (W-COMBINE-NOTHING); what takes nothing away is
named (W-COMBINE-IDLE).

Faces that are not cut stay as they are; cut faces become triangles, between the corners that they
had and the points where something else borders on them: what cutting leaves where the cut does not
show is taken out. Triangles that are one flat face (exactly in one plane, with equal face
attributes, and others that go on evenly, as texture coordinates do across a flat quad) are drawn
together, so no vertex stays where a cut crosses their diagonal. Materials stay with their faces, and where faces of two parts coincide, those of the first part stay. New vertices get
interpolated attributes, within the face that they are cut from. Faces of `with` that bound a
difference are turned round, with their normals. Where an attribute exists only in some parts, the
others get white (colours), the normal of the face, no number (nan, where attributes have no meaning
to facetmill, such as quality), or zero. After union, the face attribute group
numbers the original parts; after the others, cut_id numbers the faces that come from a part of
`with`, beginning after the numbers that are there, 0 elsewhere, so that relax and crumple can hold
them as they hold caps. Their group is 0 then, unless it is that of a cap: numbers of their own part
would be taken for those of the other. Parts are combined in the space of the part that stays, which keeps its
node; skins are dropped (W-SKIN).

After Q. Zhou, E. Grinspun, D. Zorin and A. Jacobson, "Mesh arrangements for solid geometry"
(2016).)";

} // namespace facetmill::help::combine
