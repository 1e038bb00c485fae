#pragma once
// The help and manual texts of split.

namespace facetmill::help::split {

inline constexpr const char* about = R"(Splits faces into smaller ones without cracks.)";

inline constexpr const char* details =
    R"(The surface keeps its shape and becomes finer; only the smooth methods move it. A new point on an
edge is one vertex shared by all faces at that edge, on open, closed and non-manifold meshes, so
there are no cracks and no T-junctions, and a closed surface stays closed. The Euler number and
manifoldness stay as well, except where two faces share two edges: new edges across such a corner
coincide and have more than two faces (W-SPLIT-SHARED gives the count). varignon does not cut such
corners, and diagonal uses the other diagonal where it can. Seams stay seams: there is one new wedge
per edge and pair of wedges.

Methods that cut to the centre of a face use the mean of its corners. In a concave face they use a
point from which the whole face is visible, if there is one. In concave faces without such a point,
and in concave faces cut by halve, varignon and grid, new faces may overlap (W-SPLIT-FOLDED gives
the count). fan, halve and diagonal leave triangles as they are (W-SPLIT-NOTHING, if a part has
nothing else).

Where a method cuts only some edges of a face, the neighbouring faces follow. bisect cuts every
triangle that has a cut edge at its longest edge as well (Rivara's rule), into two, three or four.
notch and halve cut a neighbouring triangle to the opposite corner, into a triangle and a quad, or
into four, and a neighbouring quad into up to four. Between passes of notch, quads are cut along a
diagonal. Methods for triangles or quads only refuse larger faces and give their number (E-POLYGON).

Smooth methods need a manifold, consistently oriented mesh (E-MANIFOLD says where it is not).
Boundaries and feature edges become smooth curves; vertices where three or more feature edges meet
stay in place.

Vertex and wedge attributes are interpolated, and face attributes are copied to the faces that
replace a face; after smooth methods normals are recomputed. Existing vertices keep their numbers. A
result of more than 2^31 corners (E-LIMIT), or one that does not fit into memory (E-MEMORY), is
refused before anything is built. A split with a target ends after the given number of passes at the
latest; the report says what stopped it (passes, max_edge, min_angle, max_faces or narrow), and
W-SPLIT-STOPPED and W-SPLIT-NOTHING report targets that were not reached. Because a split only
divides angles, min_angle makes narrow triangles smaller rather than fewer; a pass that would
increase their number is skipped, and the split of the part ends there. The report gives the longest
edge and the smallest angle before and after, in world units and degrees.

Sources: P. Bourke, 'Splitting facets' (1991); I. Rosenberg and F. Stenger, 'A lower bound on the
angles of triangles constructed by bisecting the longest side' (1975); M.-C. Rivara, 'Algorithms for
refining triangular grids suitable for adaptive and multigrid techniques' (1984); C. Loop, 'Smooth
subdivision surfaces based on triangles' (1987); L. Kobbelt, 'sqrt(3)-subdivision' (2000); D. Zorin,
P. Schroeder and W. Sweldens, 'Interpolating subdivision for meshes with arbitrary topology' (1996);
E. Catmull and J. Clark, 'Recursively generated B-spline surfaces on arbitrary topological meshes'
(1978); H. Hoppe et al., 'Piecewise smooth surface reconstruction' (1994) for feature edges.)";

} // namespace facetmill::help::split
