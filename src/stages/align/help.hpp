#pragma once
// The help and manual texts of align.

namespace facetmill::help::align {

inline constexpr const char* about = R"(Moves the scene onto another mesh, by rotation and translation.)";

inline constexpr const char* details =
    R"(Two versions of an object can then be compared: diff, ensure: {deviation: ...} and transfer need
meshes in the same place.

First the principal axes of both surfaces are matched in all 24 orders and signs, and the best start is
taken.
From there, each iteration pairs samples with the nearest points of the other mesh, and minimises the
distances to the planes there.
The farthest samples do not count (keep), so parts without a counterpart disturb little.

All selected parts move together, with their cameras and lights.
Sizes do not change, and nothing is mirrored.
The report gives the remaining distance (residual) and the matrix.
W-ALIGN warns if the residual is more than 1% of the diagonal, because the meshes then differ.
Attributes are kept.

Sources: Y. Chen and G. Medioni, 'Object modelling by registration of multiple range images' (1992);
D. Chetverikov et al., 'The trimmed iterative closest point algorithm' (2002).)";

} // namespace facetmill::help::align
