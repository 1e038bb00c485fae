#pragma once
// Joins parts that share a material and have the same attributes.

#include "mesh/scene.hpp"

#include <functional>
#include <vector>

namespace facetmill::optimize_stage {

/// A part, and the parts merged into it.
struct JoinedParts {
    std::size_t first = 0;
    std::vector<std::size_t> others;
};

/// Groups the candidate parts (ascending numbers) that share a material, directly or through other parts of
/// the group, and have the same attributes. So each part that is joined saves a draw call. Groups have two
/// or more parts. Parts with a thickness (KHR_materials_volume) must also be scaled alike.
[[nodiscard]] std::vector<JoinedParts> groups_to_join(const Scene& scene,
                                                      const std::vector<std::size_t>& candidates);

/// Groups parts that share meshes. parts_of_meshes: the parts of each mesh, ascending. Meshes whose parts
/// have the same transforms, in order, are joined in the same way at each node, so the results share a mesh
/// again.
std::vector<JoinedParts>
groups_standing_together(const Scene& scene, const std::vector<std::vector<std::size_t>>& parts_of_meshes);

/// Appends the others' meshes to the first's, in its space, and empties them. The first's transform must be
/// invertible.
void join(Scene& scene, const JoinedParts& group);

} // namespace facetmill::optimize_stage
