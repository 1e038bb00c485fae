#pragma once
// The help and manual texts of crumple.

namespace facetmill::help::crumple {

inline constexpr const char* about =
    R"(Roughens a surface: splits every face n x n and displaces every vertex by a Gaussian amount.)";

inline constexpr const char* details =
    R"(Each vertex moves once.
The amounts are normally distributed with mean 0 and the given standard deviation, cut off at
`truncate`.
Faces that share a vertex move together, so the surface does not tear and the topology is preserved.
This also holds with boundary: fixed, with caps and with a mask.
Vertices at the same position then move by the smallest share among them.
The caps of cuts stay planar, unless you use caps: free.
Faces may intersect if the amplitude is large compared with their size.

The noise at a vertex depends only on the seed and on its world position, rounded to float32.
Vertices at the same position therefore move together across seams, unwelded copies, parts and
files.
The order of vertices and the number of threads do not matter.
Far from the origin, where float32 would move vertices by a hundredth of the amplitude, positions
are rounded to 40 bits instead.
Instances of a mesh get different noise, so each gets its own mesh.

There are three exceptions.
With direction: normal, parts may separate at a shared position if their normals differ.
The option frequency counts bumps along the scene's diagonal, so two files get matching noise only
if their diagonals are equal.
Two files far from the origin may differ if only one of them is rounded to 40 bits.

With self_intersections: avoid, each position moves by a share of its displacement: 1, 1/2 ...
1/256, or 0.
First, shares are lowered until no face is stretched beyond eight times its longest edge.
If more than an eighth of a sample of faces would still intersect, this limit is halved repeatedly
(W-CRUMPLE-COARSE).

Rounds follow.
Each round finds all pairs of faces that newly intersect, fold over or lose their area, exactly.
It lowers the shares of their vertices by one step, until no such pair remains.
After eight rounds, the surrounding vertices are lowered as well.
After sixteen rounds, the surrounding region doubles in each round.

The work in each round is limited to 32 pairs of nearby triangles per face.
The limit is three times the pairs before the displacement, if that is more.
Beyond this, shares fall to an eighth at once, and to 0 after three such rounds, together with the
surrounding vertices (W-CRUMPLE-COARSE).

Pairs that intersected before are ignored.
The report gives the number of affected faces, and the number of vertices for each share.
Intersections are avoided only within a part.
W-CRUMPLE-PARTS warns when other parts are near.
If the search would need too much memory, the stage refuses to start.

The split interpolates vertex and wedge attributes and copies face attributes.
Afterwards, normals are recomputed and tangents are made perpendicular to them.
All other data is kept.
The report gives the largest and the root mean square displacement in world units.

Source: P. Bourke, 'Geometric Crumpling' (1994).)";

} // namespace facetmill::help::crumple
