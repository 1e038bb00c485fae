#pragma once
// Simplifies meshes with a common target, so that triangles stay where they are needed.

#include "geometry/simplify/simplify.hpp"

namespace facetmill {

/// A mesh, or several meshes that satisfy can_simplify_jointly and are merged for the work.
struct SharingMeshes {
    std::vector<Mesh> meshes;
    SimplifyLocks lock{};                      ///< replaces the lock of the settings
    std::optional<double> max_quadric_error{}; ///< replaces the value of the settings
    double scale = 1;     ///< scale from the space of the meshes to the space in which errors are compared
    std::size_t uses = 1; ///< how often the result is used; each use counts towards the target
};

/// Like simplify, or simplify_levels when settings has levels, for meshes with a common target. Edges are
/// collapsed in a single order of cost over all meshes, so that all meshes end at about the same cost. The
/// ratio applies to the total triangle count. Faces and vertices are totals too, and each use counts.
/// Returns [sharing][levels][meshes]; without levels, one entry. A mesh without collapses stays unchanged.
/// If no collapse is left, meshes at or below their own share of the target count as having met it.
///
/// Requires quadric, quadric-endpoints or shortest-edge. max_error and self_intersections other than ignore
/// are refused (check_simplify_sharing); use simplify_shares for them.
[[nodiscard]] std::vector<std::vector<std::vector<SimplifyResult>>>
simplify_sharing(std::vector<SharingMeshes> sharing, const SimplifySettings& settings);

/// The result of simplify_sharing without max_error and self_intersections, as counts per mesh.
struct SimplifyShares {
    std::vector<std::size_t> faces;                            ///< [sharing] triangles
    SimplifyResult::Stop stop = SimplifyResult::Stop::nothing; ///< stuck: the target was not met
};
[[nodiscard]] SimplifyShares simplify_shares(std::vector<SharingMeshes> sharing,
                                             const SimplifySettings& settings);

} // namespace facetmill
