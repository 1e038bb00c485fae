#pragma once
// The help and manual texts of clean.

namespace facetmill::help::clean {

inline constexpr const char* about = R"(Repairs a mesh step by step and leaves what is sound unchanged.)";

inline constexpr const char* details =
    R"(The steps, each on or off, are: weld, degenerate, duplicates, t_junctions, stitch, non_manifold,
self_intersections, holes, open_components, components, inner_components, isolated. They run in this
order, and again until nothing changes, so cleaning a second time changes nothing. Steps whose result needs no
decision by the user are on by default. All decisions are exact: positions, lines and planes are
compared without a tolerance unless a step is set to near.

Faces that no step affects keep their corners, attributes and order. When faces without area are
removed, the vertices on their line are inserted into the surrounding edges, so a closed surface
stays closed. Duplicate faces of opposite orientation are removed when they form an inner wall or a
fin on other faces; one of each pair is kept when they form a separate sheet (both are kept
where they belong to a closed surface, which stays closed). Where more than two faces meet at an
edge, the faces that enclose the inside between them stay connected. If other faces hold both ends
of the edge together, a point is added in its middle. Where that point must be rounded, all faces at
the edge get it; the edge stays as it is if faces would then intersect others or lose their area
(W-CLEAN).

self_intersections: union combines closed components that pass through each other or through
themselves into one solid. Their faces are cut along each other exactly, and a face is kept when it
has the outside on one side (winding number 0 or less) and the inside on the other (1 or more). Cut
faces become triangles; all others stay as they are. Cavities (components turned inward within a
solid) are kept where no other solid fills them. A component that is inside out anywhere else is
left as it is: use orient first. New vertices are rounded to floating-point coordinates. Where that
makes faces intersect again, the union is repeated up to eight times, and new vertices that are
closer to others than 1e-15 of the size of the mesh (eight times as far in each repetition) are
merged with them. If intersections remain after that, the mesh is left as it was. local replaces
intersecting faces region by region, with up to four rings of faces around them if needed. A region
is left as it was where the replacement would open the surface, change its topology, remove half of
a component or leave an intersection.

The work is bounded: if more than 32 pairs of bounding boxes per face plus 33 million in total
overlap, intersections are not searched for. After a million intersecting pairs of faces have been
processed without success, parts with more such pairs than faces are left as they are.

Holes that touch at a vertex are filled separately. A hole is left open when its patch would not
fit, when the patch would intersect other faces, or when the neighbouring faces are oriented
inconsistently (use orient first). With self_intersections: union or all, a patch may intersect
other faces, because the next union resolves that. The report lists the repairs that could not be
done (W-CLEAN).

With precision: single, vertices that are still at one position (where solids touch, and were
separated) are moved apart last, by 2 to 256 steps of 32-bit floats, the size of a step being that at
the farthest coordinate. Nothing is moved that would turn a face over, take its area or make it meet
another, which is decided exactly; such vertices stay where they are (W-CLEAN). apart: false leaves
all of them where they are.

unit_vectors: true, which is last, mends normals, tangents and joint weights that the checks
unit_normals and weights_normalized refuse. Others keep their values.

The attributes of remaining elements are kept. At new vertices they are interpolated, and patches
copy the face attributes of the faces at their boundary edges. The report counts what each step did.)";

} // namespace facetmill::help::clean
