#pragma once
// The help and manual texts of relax.

namespace facetmill::help::relax {

inline constexpr const char* about =
    R"(Smooths a surface by moving every vertex towards the mean of its neighbours.)";

inline constexpr const char* details =
    R"(In each iteration a vertex P moves to P + lambda / n * sum(Pj - P), the sum taken over its n
neighbours Pj, for all vertices simultaneously; so neither their order nor the number of threads
matters. A closed surface shrinks a little with every iteration of laplacian, cotangent and
implicit; taubin and hc nearly keep its volume. The report gives area and volume before and after.
With until and no method, hc is used (alpha 0.1), which converges near the original surface; a
method that shrinks the surface is stopped before a third of the area is lost (W-RELAX-STOPPED).
Open, non-manifold and degenerate input is accepted as it is: faces without area have no weight, and
a vertex without neighbours stays in place.

The caps of cuts stay planar (caps: free moves them as well). Other sharp edges become round unless
feature_angle is given.

Faces, wedges and topology are kept, and with them the Euler number and closedness. Normals are
recomputed, and tangents are made perpendicular to them. Morph targets of positions are relaxed
together with the surface, each as the surface that it represents; all other attributes are kept.
The report gives the number of vertices that moved and of those that were held in place, and the
largest displacement, in world units.

Sources: P. Bourke, 'Surface Relaxation and Smoothing' (1997); G. Taubin, 'A signal processing
approach to fair surface design' (1995); U. Pinkall and K. Polthier, 'Computing discrete minimal
surfaces and their conjugates' (1993); M. Desbrun et al., 'Implicit fairing of irregular meshes
using diffusion and curvature flow' (1999); J. Vollmer, R. Mencl and H. Mueller, 'Improved Laplacian
smoothing of noisy surface meshes' (1999).)";

} // namespace facetmill::help::relax
