#pragma once
// Groups faces into connected clusters of similar normals.

#include "geometry/unwrap/surface.hpp"

namespace facetmill::unwrap_room {

/// Merges faces into clusters, without leaving their group. The deviation of a cluster is 1 - |N| / A, with
/// the sum N of its area vectors and its area A; limit_of_group bounds it. Faces of the group `none` stay
/// out. Returns the cluster of each face, numbered by first face, or none, and sets the count.
///
/// All pairs of clusters that are each other's nearest neighbour merge at once, round by round. For a metric
/// that merging never brings closer, this gives the same tree as merging the nearest pair of all (F. Murtagh,
/// "A survey of recent advances in hierarchical clustering algorithms", 1983), and it runs in parallel.
[[nodiscard]] std::vector<Index> cluster_faces(const UnwrapSurface& surface,
                                               const std::vector<Index>& group_of_face,
                                               const std::vector<double>& limit_of_group, std::size_t& count);

} // namespace facetmill::unwrap_room
