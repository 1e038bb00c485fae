#pragma once
// Meshes that share one target: triangles stay where they are needed.

#include "geometry/simplify/simplify.hpp"

namespace facetmill {

/// A mesh, or several for which can_simplify_jointly holds and which are worked on as one.
struct SharingMeshes {
    std::vector<Mesh> meshes;
    SimplifyLocks lock{};                      ///< in place of that of the settings
    std::optional<double> max_quadric_error{}; ///< likewise
    double scale = 1;     ///< takes lengths of the meshes' space to the one in which errors are compared
    std::size_t uses = 1; ///< how often the result is used: what a collapse takes away counts as often
};

/// As simplify, or simplify_levels when settings has levels, of meshes with one target for all: edges are
/// collapsed in one order of cost over all of them, so that all end at about the same cost. The ratio asks
/// for as many triangles as it would of each; faces and vertices are those of all, and each use counts.
/// [sharing][levels][meshes]; without levels there is one. A mesh in which no collapse was made stays as it
/// came; when no collapse is left, those that are at or below their own part of the target have met it.
///
/// Requires quadric, quadric-endpoints or shortest-edge; max_error and self_intersections other than ignore
/// are refused (check_simplify_sharing), see simplify_shares.
std::vector<std::vector<std::vector<SimplifyResult>>> simplify_sharing(std::vector<SharingMeshes> sharing,
                                                                       const SimplifySettings& settings);

/// What each would have after simplify_sharing without max_error and self_intersections.
struct SimplifyShares {
    std::vector<std::size_t> faces;                            ///< [sharing] triangles
    SimplifyResult::Stop stop = SimplifyResult::Stop::nothing; ///< stuck: the target was not met
};
SimplifyShares simplify_shares(std::vector<SharingMeshes> sharing, const SimplifySettings& settings);

} // namespace facetmill
