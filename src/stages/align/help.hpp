#pragma once
// The help and manual texts of align.

namespace facetmill::help::align {

inline constexpr const char* about = R"(Moves the scene onto another mesh, by rotation and translation.)";

inline constexpr const char* details =
    R"(Use align before diff, ensure: {deviation: ...} and transfer, which need meshes at the same position.

The stage first tries the current position and all 24 rotations that match the principal axes of both
surfaces.
From the best start, each iteration pairs samples of the scene with the nearest points of the other mesh.
It then minimises the distances of the samples from the planes of the nearest faces.
The option keep leaves out the farthest samples, so areas without a counterpart have little effect.

All selected parts move together, with their cameras and lights.
Sizes do not change, and nothing is mirrored.
The report gives the remaining distance (residual) and the matrix.
W-ALIGN warns if the residual is more than 1% of the diagonal, because the meshes then differ.
Attributes are kept.

Sources: Y. Chen and G. Medioni, 'Object modelling by registration of multiple range images' (1992);
D. Chetverikov et al., 'The trimmed iterative closest point algorithm' (2002).)";

} // namespace facetmill::help::align
