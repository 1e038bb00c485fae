#pragma once
// What the help and the manual say about crumple.

namespace facetmill::help::crumple {

inline constexpr const char* about =
    R"(Roughens a surface: splits every face n x n and displaces every vertex by a Gaussian amount.)";

inline constexpr const char* details =
    R"(Each vertex moves once, by normally distributed amounts with mean 0 and the given standard
deviation, cut off at `truncate`. Faces that share a vertex move together, so nothing tears and the
topology is kept. This also holds with boundary: fixed and under a mask, where all vertices at one
position move by the smallest share of any of them. Faces may come to intersect when the amplitude
is large compared with their size.

The noise at a vertex depends only on the seed and on its world position rounded to float32:
vertices at one position move together across seams, unwelded copies, parts and files, and neither
the order of vertices nor the number of threads matters. There are two exceptions. Along the normal,
a position shared by several parts has a normal in each of them, so the parts may separate there;
and frequency is relative to the scene, so files are crumpled alike only when their diagonals are
equal.

With self_intersections: avoid, each position has a share of its move: 1, 1/2 ... 1/256, or 0. First
the shares are lowered until no face is drawn out by more than eight times its longest edge, or, where
a sample of the faces tells that more than an eighth of them would intersect others, by more than half
of that, and so on (W-CRUMPLE-HURRIED). Then, in every round, all pairs of faces that newly intersect,
fold over or lose their area are found exactly, and their vertices take the next lower share, all at
once, until there are no such pairs; after eight rounds the vertices around them do so as well, and
after sixteen twice as far around in each round. The work is bounded: once 32 pairs of nearby triangles
were looked at for each face, or three times as many as there were before, shares fall to an eighth at
once, and after three such rounds to 0, also around (W-CRUMPLE-HURRIED). Pairs that intersected before
are exempt. The report says how many faces were concerned and how many vertices got which share. Only
faces of the same part are kept apart (W-CRUMPLE-PARTS warns when other parts are near). If the search
needs more memory than there is, it is refused before it starts.

The split interpolates vertex and wedge attributes and copies face attributes; then normals are
recomputed, tangents are made perpendicular to them, and everything else is kept. The report gives
the largest and the root mean square displacement, in world units.

Source: P. Bourke, 'Geometric Crumpling' (1994).)";

} // namespace facetmill::help::crumple
