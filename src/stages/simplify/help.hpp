#pragma once
// The help and manual texts of simplify.

namespace facetmill::help::simplify {

inline constexpr const char* about =
    R"(Reduces the number of faces while keeping the shape, the topology and the attributes.)";

inline constexpr const char* details =
    R"(Edges are collapsed, the cheapest first, until a target is met. With several targets, simplification
ends at the first one that is met; the report names it and gives the ratio achieved and what keeps
the remaining edges from collapsing. Polygons are triangulated first. The method quadric measures
the area-weighted squared distance to the planes of all faces that a vertex represents; edges at
which two faces fold back on each other by more than 90 degrees are treated like boundary edges.
shortest-edge always collapses the shortest edge. Collapses run in passes with a common cost
threshold, so they follow the order of cost except at vertices that the same pass has already
changed.

Several parts have one target (share: error): edges are collapsed in one order of cost over all of
them, in world space, until all parts together have the requested number of triangles or vertices;
the same holds for each level of lods. A part that needs all its triangles is left unchanged. Where
a node scales unevenly, its largest scale counts. Parts with the same mesh and the same scale
(instances) are simplified once and get the same result; each of them counts, so the result may be
below the target by one collapse per instance. With max_error or self_intersections, the share of
each part is first determined in this way, and then each part is simplified to its share. share:
equal gives each part the ratio, or a share of faces and vertices in proportion to its own; the
methods cluster and constrained, which have no comparable costs, always do so.

To keep the shape, simplification stops above the target when necessary: no collapse of the quadric
methods has a larger error (see largest_error below) than max_quadric_error, by default 1 % of the
diagonal of the part's bounding box in its local space (for parts simplified as one, of their
common box). W-SIMPLIFY-LIMIT reports this, unless borders, seams or non-manifold regions keep
more edges from collapsing. Within this limit a scan can be reduced to a few hundred triangles, and
a box in a collection stays a box. max_quadric_error does not limit the measured deviation, which is
usually two to four times as large; max_error limits the deviation, and replaces max_quadric_error.
With max_quadric_error: off, the surface is simplified to the target regardless of the error.

By default these are guaranteed: a closed manifold stays closed and manifold; genus, components and
boundary loops are kept; no face turns by more than 60 degrees in one collapse; and no face becomes
degenerate or a duplicate. Edges on boundaries, UV seams, sharp normal seams, and the borders of
materials and groups are collapsed only along these lines, and both sides stay matched; a vertex
where several such lines meet stays in place. The same holds for boundaries at exactly the same
position, within a part and between parts: parts with the same node transform, attributes and
shading whose boundaries coincide are simplified as one. Where a part meets another that differs in
these, or that is not selected, its vertices stay in place. Non-manifold vertices stay in
place, with the edges between them; others may be collapsed into them. Neighbouring faces that are
oriented inconsistently are simplified as if they were consistent, and each face keeps its orientation. With shortest-edge, vertices at which a boundary turns by more
than the feature angle stay in place. Isolated vertices are removed. With topology: allow,
components may vanish, holes may close and handles may be pinched off, which can leave edges of four
faces; the report gives the counts before and after. The method cluster keeps neither topology nor
borders, and reports that in the same way.

UVs, normals, colours and skin weights enter the error of the quadric methods with weights. A vertex
that moved takes the attributes of the original surface at the nearest point of the faces that it
replaces, so textures do not slide; faces keep theirs. Wedges that differ only in their normals are
merged below the feature angle; a flat-shaded mesh gets the normals of its new faces.

The deviation is measured in both directions at 100,000 samples and at all vertices, with seed 1.
The root mean square and the mean are of as many samples as a standard error of 0.5 % takes; on
triangles where eight or more of these stay below half of the maximum, the others are left out of
the maximum.
Several parts share the samples: half are assigned by area, half by the number of triangles. The
report gives the number of samples of each part. max_error limits this deviation, which is reported
under deviation, in scene units and as a percentage of the part's diagonal. Points of the surface
are tracked during simplification, and collapses that exceed the limit in the end are undone one by
one. This takes many times as long as a ratio. The method cluster meets the limit by the size of its
cells.

lods makes a chain of levels of detail: each level is made by further collapses from the previous
one. write: {path: x.glb, lods: true} puts the levels into one file as MSFT_lod; without lods they
are written as nodes side by side. only: "*.lod1" writes one level into a file of its own.

The method constrained keeps boundaries, seams and borders vertex by vertex.

Where facetmill run --memory 2G finds that the mesh needs more, load and simplify work on cells on
disk: each is simplified while the vertices that it shares with others are held, then two to four as
one, up to the whole, so no border is left and a closed surface stays closed. This takes ratio or
faces and the quadric methods; the deviation is not measured then. E-CELLS names what needs the mesh
in memory.

largest_error is, for quadric and cluster, the largest root mean square distance of a new vertex to
its planes; for shortest-edge, half the length of the longest edge collapsed; for constrained, null.
A target at or above the input does nothing (W-SIMPLIFY-NOTHING, unless it is 100 %). When no
collapse is left, simplification stops, and W-SIMPLIFY-STOPPED gives the reason. self_intersections:
avoid repeats the simplification up to ten times, each time with half the allowed error for faces
that came to intersect, and then up to six times with those faces left unchanged; the number of
intersections that remain is reported.

Sources: P. Bourke, 'Surface (polygonal) Simplification' (1997); M. Garland and P. Heckbert,
'Surface simplification using quadric error metrics' (1997); H. Hoppe, 'New quadric metric for
simplifying meshes with appearance attributes' (1999); J. Rossignac and P. Borrel, 'Multi-resolution
3D approximations for rendering complex scenes' (1993) and P. Lindstrom, 'Out-of-core simplification
of large polygonal models' (2000) for cluster.)";

} // namespace facetmill::help::simplify
