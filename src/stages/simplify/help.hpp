#pragma once
// The help and manual texts of simplify.

namespace facetmill::help::simplify {

inline constexpr const char* about =
    R"(Reduces the number of faces and preserves the shape, the topology and the attributes.)";

inline constexpr const char* details =
    R"(The stage collapses edges, the cheapest first, until it meets a target.
If you give several targets, it stops at the first one that is met.
The report names this target, the achieved ratio, and the reasons that prevent further collapses.
Polygons are triangulated first.

The method quadric measures the area-weighted squared distance to the planes of all faces that a
vertex represents.
Edges where two faces fold back by more than 90 degrees are treated like boundary edges.
The method shortest-edge always collapses the shortest edge.
Collapses run in passes with a common cost threshold.
They follow the order of cost except at vertices that changed in the same pass.

By default, several parts share one target (share: error).
Edges of all parts are collapsed in a single order of cost, in world space.
This continues until all parts together have the requested number of triangles or vertices.
Each level of lods works in the same way.
A part that needs all its triangles is left unchanged.
If a node scales unevenly, its largest scale counts.

Instances (parts with the same mesh and scale) are simplified once and share the result.
Each instance counts, so the result may be below the target by one collapse per instance.
With max_error or self_intersections, the stage first finds the share of each part, then simplifies
each part to it.
The option share: equal applies the ratio to each part, or a share of faces and vertices in
proportion to its size.
The methods cluster and constrained always use share: equal because their costs are not comparable.

To preserve the shape, simplification may stop above the target.
No collapse of the quadric methods may have a larger error (largest_error, see below) than
max_quadric_error.
The default is 1 % of the diagonal of the part's bounding box in its local space.
Parts that are simplified together use their common bounding box.
W-SIMPLIFY-LIMIT warns if this limit stops the simplification, unless borders, seams or non-manifold
regions block more edges.
Within this limit, a scan can be reduced to a few hundred triangles, and a box in a collection stays
a box.

The option max_quadric_error does not limit the measured deviation, which is usually two to four
times as large.
The option max_error limits the deviation and replaces max_quadric_error.
With max_quadric_error: off, the surface is simplified to the target regardless of the error.

By default, a closed manifold stays closed and manifold.
Genus, components and boundary loops are preserved.
No face turns by more than 60 degrees in one collapse, and no face becomes degenerate or a
duplicate.

Edges on boundaries, UV seams, sharp normal seams, and borders of materials and groups collapse only
along these lines.
The two sides of a seam stay matched.
A vertex where several such lines meet does not move.
Boundaries at exactly the same position are also matched, within a part and between parts.
For this, parts with coincident boundaries and the same node transform, attributes and shading are
simplified together.
Vertices of a part do not move if they meet a different or unselected part.

Non-manifold vertices and the edges between them stay unchanged, but other vertices may collapse
into them.
Faces with inconsistent orientation are simplified as if they were consistent, and then get their
orientation back.
With shortest-edge, vertices where a boundary turns by more than the feature angle do not move.
Isolated vertices are removed.

With topology: allow, components may vanish, holes may close and handles may be pinched off.
This can leave edges with four faces, and the report gives the counts before and after.
The method cluster preserves neither topology nor borders, and reports the same counts.

The error of the quadric methods includes UVs, normals, colours and skin weights, each with a
weight.
A moved vertex takes its attributes from the nearest point of the original faces that it replaces,
so textures do not slide.
Faces keep their attributes.
Wedges that differ only in their normals are merged if their faces meet at less than the feature
angle.
A flat-shaded mesh gets the normals of its new faces.

The deviation is measured in both directions at 100,000 samples and at all vertices, with seed 1.
The root mean square and the mean use enough samples for a standard error of 0.5 %.
If at least eight of these samples on a triangle stay below half of the maximum, its other samples
are not used for the maximum.
Several parts share the samples: half by area, half by number of triangles.
The report gives the number of samples of each part.

The option max_error limits this deviation.
The report gives it in scene units and as a percentage of the part's diagonal.
Points on the surface are tracked, and collapses that exceed the limit in the end are undone one by
one.
A limit by max_error takes many times as long as a ratio.
The method cluster meets the limit by the size of its cells.

The option lods makes a chain of levels of detail, each simplified further from the previous level.
Use write: {path: x.glb, lods: true} to store the levels in one file as MSFT_lod.
Without lods: true, write stores them as separate nodes.
Use only: "*.lod1" to write a single level to its own file.

The method constrained preserves every vertex on boundaries, seams and borders.

If the mesh needs more memory than facetmill run --memory 2G allows, load and simplify process cells
on disk.
Each cell is simplified, but its shared vertices do not move.
Then groups of two to four cells are joined and simplified, until one group is the whole mesh.
No borders remain, and a closed surface stays closed.
This needs ratio or faces and a quadric method, and does not measure the deviation.
E-CELLS names options that need the mesh in memory.

The result largest_error depends on the method.
For quadric and cluster, it is the largest root mean square distance of a new vertex to its planes.
For shortest-edge, it is half the length of the longest collapsed edge.
For constrained, it is null.

A target at or above the size of the input changes nothing (W-SIMPLIFY-NOTHING, unless it is 100 %).
If no collapse remains, simplification stops and W-SIMPLIFY-STOPPED gives the reason.

The option self_intersections: avoid repeats the simplification up to ten times, and halves the
allowed error of faces that intersect each time.
It then tries up to six times with these faces unchanged.
The report gives the number of remaining intersections.

Sources: P. Bourke, 'Surface (polygonal) Simplification' (1997); M. Garland and P. Heckbert,
'Surface simplification using quadric error metrics' (1997); H. Hoppe, 'New quadric metric for
simplifying meshes with appearance attributes' (1999); J. Rossignac and P. Borrel, 'Multi-resolution
3D approximations for rendering complex scenes' (1993) and P. Lindstrom, 'Out-of-core simplification
of large polygonal models' (2000) for cluster.)";

} // namespace facetmill::help::simplify
