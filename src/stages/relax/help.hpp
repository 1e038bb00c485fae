#pragma once
// The help and manual texts of relax.

namespace facetmill::help::relax {

inline constexpr const char* about =
    R"(Smooths a surface by moving every vertex towards the mean of its neighbours.)";

inline constexpr const char* details =
    R"(In each iteration, a vertex P moves to P + lambda / n * sum(Pj - P), where Pj are its n neighbours.
All vertices move simultaneously, so neither their order nor the number of threads matters.

The methods laplacian, cotangent and implicit shrink a closed surface a little in every iteration.
The methods taubin and hc nearly preserve its volume.
The report gives area and volume before and after.
If you give until but no method, the method is hc with alpha 0.1, which converges near the original
surface.
A method that shrinks the surface stops before a third of the area is lost (W-RELAX-STOPPED).

Open, non-manifold and degenerate input is accepted.
Faces without area have no weight.
A vertex without neighbours does not move.

The caps of cuts stay planar, unless you use caps: free.
Sharp edges become round unless you give feature_angle.

Faces, wedges and topology do not change.
Normals are recomputed, and tangents are made perpendicular to them.
Position morph targets are relaxed together with the surface.
For this, the displaced surface of each target is relaxed.
All other attributes are kept.
The report gives the number of moved and fixed vertices, and the largest displacement in world
units.

Sources: P. Bourke, 'Surface Relaxation and Smoothing' (1997); G. Taubin, 'A signal processing
approach to fair surface design' (1995); U. Pinkall and K. Polthier, 'Computing discrete minimal
surfaces and their conjugates' (1993); M. Desbrun et al., 'Implicit fairing of irregular meshes
using diffusion and curvature flow' (1999); J. Vollmer, R. Mencl and H. Mueller, 'Improved Laplacian
smoothing of noisy surface meshes' (1999).)";

} // namespace facetmill::help::relax
