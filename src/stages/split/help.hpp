#pragma once
// The help and manual texts of split.

namespace facetmill::help::split {

inline constexpr const char* about = R"(Splits faces into smaller ones without cracks.)";

inline constexpr const char* details =
    R"(The surface keeps its shape and becomes finer.
Only the smooth methods move it.
A new point on an edge is a single vertex, shared by all faces at that edge.
This holds on open, closed and non-manifold meshes.
There are no cracks and no T-junctions, and a closed surface stays closed.

The Euler number and manifoldness are preserved, except where two faces share two edges.
New edges across such a corner coincide and have more than two faces (W-SPLIT-SHARED gives the
count).
The method varignon does not cut such corners, and diagonal uses the other diagonal if possible.
Seams are preserved: a new point on an edge gets one wedge for each pair of wedges at its ends.

Some methods cut to the centre of a face, which is the mean of its corners.
In a concave face, they use a point that sees the whole face, if one exists.
New faces may overlap in concave faces without such a point.
New faces may also overlap in concave faces cut by halve, varignon and grid (W-SPLIT-FOLDED gives
the count).
The methods fan, halve and diagonal leave triangles unchanged (W-SPLIT-NOTHING, if a part has only
triangles).

If a method cuts only some edges of a face, the neighbouring faces are cut as well.
The method bisect also cuts every triangle with a cut edge at its longest edge (Rivara's rule), into
two, three or four.
The methods notch and halve cut a neighbouring triangle into two triangles (one cut edge), a
triangle and a quad (two), or four triangles (three).
They cut a neighbouring quad into up to four faces.
Between passes, notch cuts quads along a diagonal.
Methods for triangles or quads refuse larger faces and report their number (E-POLYGON).

Smooth methods need a manifold, consistently oriented mesh.
E-MANIFOLD reports the position of a fault.
Boundaries and feature edges become smooth curves.
Vertices where three or more feature edges meet do not move.

Vertex and wedge attributes are interpolated, and new faces copy the face attributes of their
original face.
Smooth methods recompute normals.
Existing vertices keep their numbers.
The stage refuses a result with more than 2^31 corners (E-LIMIT), or one that does not fit into
memory (E-MEMORY), before it starts.

A split with a target ends after the given number of passes at the latest.
The report gives the reason: passes, max_edge, min_angle, max_faces or narrow.
W-SPLIT-STOPPED and W-SPLIT-NOTHING report targets that were not reached.
A split only divides angles, so min_angle makes narrow triangles smaller, not fewer.
If a pass would increase their number, it is skipped and the split of the part ends.
The report gives the longest edge and the smallest angle before and after, in world units and
degrees.

Sources: P. Bourke, 'Splitting facets' (1991); I. Rosenberg and F. Stenger, 'A lower bound on the
angles of triangles constructed by bisecting the longest side' (1975); M.-C. Rivara, 'Algorithms for
refining triangular grids suitable for adaptive and multigrid techniques' (1984); C. Loop, 'Smooth
subdivision surfaces based on triangles' (1987); L. Kobbelt, 'sqrt(3)-subdivision' (2000); D. Zorin,
P. Schroeder and W. Sweldens, 'Interpolating subdivision for meshes with arbitrary topology' (1996);
E. Catmull and J. Clark, 'Recursively generated B-spline surfaces on arbitrary topological meshes'
(1978); H. Hoppe et al., 'Piecewise smooth surface reconstruction' (1994) for feature edges.)";

} // namespace facetmill::help::split
