#pragma once
// The help and manual texts of crumple.

namespace facetmill::help::crumple {

inline constexpr const char* about =
    R"(Roughens a surface: splits every face n x n and displaces every vertex by a Gaussian amount.)";

inline constexpr const char* details =
    R"(Each vertex moves once, by normally distributed amounts with mean 0 and the given standard
deviation, cut off at `truncate`. Faces that share a vertex move together, so nothing tears and the
topology is kept. This also holds with boundary: fixed, with caps and with a mask, where all
vertices at one position move by the smallest share of any of them. The caps of cuts stay planar
(caps: free moves them as well). Faces may intersect when the amplitude is large
compared with their size.

The noise at a vertex depends only on the seed and on its world position rounded to float32 (to 40
bits in scenes so far from the origin that float32 would move them by a hundredth of the amplitude):
vertices at one position move together across seams, unwelded copies, parts and files, and neither
the order of vertices nor the number of threads matters. For the same reason instances of one mesh
differ afterwards, and each has its own mesh. There are three exceptions to the rule. Along the
normal, a position shared by several parts has a normal in each of them, so the parts may separate
there; frequency is relative to the scene, so files are crumpled alike only when their diagonals are
equal; and of two files at that distance from the origin one may be beyond it and the other not.

With self_intersections: avoid, each position moves by a share of its displacement: 1, 1/2 ...
1/256, or 0. First, the shares are lowered until no face is stretched by more than eight times its
longest edge. If more than an eighth of a sample of the faces would still intersect others, this
limit is halved, and halved again until at most an eighth of the sample does (W-CRUMPLE-COARSE).
Then rounds follow: each finds exactly all pairs of faces that newly intersect, fold over or lose
their area, and gives their vertices the next lower share, until there are no such pairs. After
eight rounds the surrounding vertices get a lower share as well; after sixteen rounds, the
surrounding region doubles in each round. The work is bounded: once a round has examined 32 pairs of
nearby triangles per face, or three times as many as there were before the displacement, shares fall
to an eighth at once; after three such rounds they fall to 0, including the vertices around them
(W-CRUMPLE-COARSE). Pairs that intersected before are exempt. The report gives the number of faces
affected and the number of vertices for each share. Intersections are avoided only between faces of
the same part (W-CRUMPLE-PARTS warns when other parts are near). If the search needs more memory
than there is, it is refused before it starts.

The split interpolates vertex and wedge attributes and copies face attributes; then normals are
recomputed, tangents are made perpendicular to them, and everything else is kept. The report gives
the largest and the root mean square displacement, in world units.

Source: P. Bourke, 'Geometric Crumpling' (1994).)";

} // namespace facetmill::help::crumple
