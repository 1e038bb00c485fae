#pragma once
// What the help and the manual say about simplify.

namespace facetmill::help::simplify {

inline constexpr const char* about =
    R"(Reduces the number of faces while keeping the shape, the topology and the attributes.)";

inline constexpr const char* details =
    R"(Edges are collapsed, the cheapest first, until a target is met. With several targets the first one
met ends the work; the report names it and gives the ratio achieved and what keeps the remaining
edges from collapsing. Polygons are triangulated first. The method quadric measures the
area-weighted squared distance to the planes of all faces that a vertex represents; edges where two
faces turn back on each other by more than 90 degrees are held as boundaries are. shortest-edge
always collapses the shortest edge. Collapses run in passes with a common cost threshold, so they
follow the order of cost except at vertices that the same pass has already changed.

Several parts have one target (share: error): edges are collapsed in one order of cost over all of
them, in world space, until all together have as many triangles or vertices as were asked for; so
does each level of lods. A part that needs all its triangles stays as it came. Where a node scales
unevenly, its largest scale counts. Parts with one mesh and one scale are worked on once and get one
result, and each of them counts, so that the work may go beyond the target by one collapse in each.
With max_error or self_intersections, the shares are found so first, and each part is simplified
to its share. share: equal gives each part the ratio, or its share of faces and vertices in
proportion to its own; the methods cluster and constrained, which have no cost to compare, always do.

The work stops above the target rather than lose the shape: no collapse of the quadric methods has a
larger error (see largest_error below) than max_quadric_error, 1 % of the diagonal of the part's box
in its own axes; of parts simplified as one, of the box of all. W-SIMPLIFY-CEILING says so, unless
borders, seams or non-manifold places hold more edges. Scans reach a few hundred triangles within
it; the boxes of a collection of them stay boxes. It is not the measured deviation, which is usually two to four times
as large; max_error limits that, and takes the place of max_quadric_error. max_quadric_error: off
goes on to the target whatever becomes of the shape.

Guaranteed by default: a closed manifold stays closed and manifold; genus, components and boundary
loops are kept; no face turns by more than 60 degrees in one collapse; and no face becomes
degenerate or a duplicate. Boundaries, UV seams, sharp normal seams, and the borders of materials
and groups collapse only along themselves and stay matched; where several of them meet, the vertex
stays. The same holds for boundaries at exactly the same position, within a part and between parts:
parts with the same node transform, attributes and shading whose boundaries coincide are simplified
as one. Where a part meets another that differs in these, or that is not
selected, its vertices stay. Non-manifold regions are left as they are. Where neighbouring faces are
oriented inconsistently, the work is done as if they agreed, and each face keeps its orientation.
With shortest-edge, vertices where a boundary turns by more than the feature angle stay. Isolated
vertices are removed. With topology: allow, components may vanish, holes may close and
handles may be pinched off, which can leave edges of four faces; the report gives the counts before
and after. The method cluster keeps neither topology nor borders, and reports that in the same way.

UVs, normals, colours and skin weights enter the error of the quadric methods with weights. A vertex
that moved takes the attributes of the original surface at the nearest point of the faces that it
replaces, so textures do not slide; faces keep theirs. Wedges that differ only in their normals are
merged below the feature angle; a flat-shaded mesh gets the normals of its new faces.

The deviation is measured at 100,000 samples each way and at all vertices, seed 1. Several parts
share the samples: half go by area, half by the number of triangles. The report gives the number of
each. max_error limits the deviation measured so, which is reported under deviation, in scene units
and as a percentage of the part's diagonal. Points of
the surface are tracked during simplification, and whatever exceeds the limit in the end is undone
collapse by collapse. This takes many times as long as a ratio. cluster meets the limit by the size
of its cells.

lods makes one chain: each level is reached by further collapses from the level before. write:
{path: x.glb, lods: true} puts the levels into one file as MSFT_lod; without lods they are written
as nodes side by side. only: "*.lod1" writes one level into a file of its own.

The method constrained keeps boundaries, seams and borders vertex by vertex.

largest_error is, for quadric and cluster, the largest root mean square distance of a new vertex to
its planes; for shortest-edge, half the length of the longest edge collapsed; for constrained, null.
A target at or above the input does nothing (W-SIMPLIFY-NOTHING, unless it is 100 %). When no collapse is left, the work
stops and says why (W-SIMPLIFY-STOPPED). self_intersections: avoid repeats the whole work up to ten
times, each time with half the error allowed for faces that came to intersect, and then up to six
times with those faces kept as they were; the count that remains is reported.

Sources: P. Bourke, 'Surface (polygonal) Simplification' (1997); M. Garland and P. Heckbert,
'Surface simplification using quadric error metrics' (1997); H. Hoppe, 'New quadric metric for
simplifying meshes with appearance attributes' (1999); J. Rossignac and P. Borrel, 'Multi-resolution
3D approximations for rendering complex scenes' (1993) and P. Lindstrom, 'Out-of-core simplification
of large polygonal models' (2000) for cluster.)";

} // namespace facetmill::help::simplify
