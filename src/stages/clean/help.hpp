#pragma once
// The help and manual texts of clean.

namespace facetmill::help::clean {

inline constexpr const char* about = R"(Repairs a mesh step by step and leaves correct faces unchanged.)";

inline constexpr const char* details =
    R"(You can turn each step on or off.
The steps run in this order: weld, degenerate, duplicates, t_junctions, stitch, non_manifold,
self_intersections, holes, open_components, components, inner_components, isolated.
They are repeated until nothing changes, so a second clean changes nothing.
Steps that need no decision from you are on by default.
All decisions are exact: positions, lines and planes are compared without a tolerance, unless you
set a step to near.

Unaffected faces keep their corners, attributes and order.
When a face without area is removed, its vertices are inserted into the surrounding edges, so a
closed surface stays closed.
Duplicate faces of opposite orientation are removed if they form an inner wall, or a fin on other
faces.
If they form a separate sheet, one face of each pair is kept.
If they belong to a closed surface, both are kept and the surface stays closed.
With walls: false, one face of each orientation is kept.

At an edge with more than two faces, the faces that enclose the same inside stay connected.
If other faces connect both ends of the edge, a point is added in its middle.
If that point must be rounded, all faces at the edge use it.
The edge stays unchanged if the point would make faces intersect or lose their area (W-CLEAN).

The step self_intersections: union combines closed components that pass through each other or
themselves into a single solid.
Faces are cut exactly where they intersect.
A face is kept if one side is outside (winding number 0 or less) and the other is inside (1 or
more).
Cut faces become triangles.
Other faces stay unchanged.
Cavities (components turned inward inside a solid) are kept unless another solid fills them.
Other components that are inside out are not changed, so use orient first.

New vertices are rounded to floating-point coordinates.
If faces then intersect again, the union is repeated up to eight times.
Each repetition merges new vertices that are very close to others: within 1e-15 of the mesh size at
first, eight times as far each time.
If intersections remain, the mesh is not changed.

The step self_intersections: local replaces intersecting faces region by region, with up to four
surrounding rings of faces.
A region is not changed if its replacement would open the surface, change the topology, remove half
of a component or leave an intersection.

The search for intersections is limited.
It is skipped if the number of overlapping bounding box pairs exceeds 33 million plus 32 per face.
If a million pairs of intersecting faces could not be resolved, later parts with more such pairs than
faces are left unchanged.

Holes that touch at a vertex are filled separately.
A hole stays open if its patch does not fit or would intersect other faces.
It also stays open if the faces around it are oriented inconsistently, so use orient first.
With self_intersections: union or all, a patch may intersect other faces, because the next union
resolves that.
The report lists the repairs that failed (W-CLEAN).

With precision: single, vertices that share a position after the repairs are moved apart as the last
step.
Such vertices appear where touching solids were separated.
They move by 2 to 256 steps of a 32-bit float at the farthest coordinate.
No move may invert or flatten a face or make it meet another one.
This test is exact, and vertices that fail it do not move (W-CLEAN).
With apart: false, no vertex moves.

The step hidden: true runs first, and removes faces that no ray from outside reaches.
Each part can hide faces of other parts. Parts are tested in the pose and at all instances that viewers show.
Parts that animations or morph targets move keep their faces and hide nothing. So do parts that viewers do not
draw.
Parallel rays first cover the scene in 14 directions.
They are so close that an opening in one of these directions lets a ray through if it is wider than gap.
From each face that no such ray reaches, up to 256 rays in evenly spread directions test for a way out.
Faces that share a vertex with a reached face are kept.
The report gives the number of rays, and the number and area of the removed faces.

The step unit_vectors: true runs last.
It repairs normals, tangents and joint weights that glTF does not accept, as `normals: keep` does.
Other values stay unchanged.

Remaining elements keep their attributes.
New vertices get interpolated attributes.
Patches copy the face attributes of the faces around the hole.
The report counts the repairs of each step.)";

} // namespace facetmill::help::clean
