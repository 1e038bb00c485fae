#pragma once
// Parts joined that are drawn alike.

#include "mesh/scene.hpp"

#include <functional>
#include <vector>

namespace facetmill::optimize_stage {

/// Primitives that have faces: what a part costs a renderer, which draws each by itself.
std::size_t draw_calls(const Mesh& mesh);

/// One primitive for all of the mesh that have one material and the same attributes, as far as they have
/// neither extras nor extensions. Whether anything changed.
bool join_primitives(Mesh& mesh);

/// A part, and those that go into it.
struct JoinedParts {
    std::size_t first = 0;
    std::vector<std::size_t> others;
};

/// The parts that may be joined (by their numbers, rising), in groups of two and more that share materials
/// and have the same attributes.
std::vector<JoinedParts> groups_to_join(const Scene& scene, const std::vector<std::size_t>& candidates);

/// The same of parts that share meshes: of each mesh the parts that have it, rising. Meshes whose parts stand
/// at the same places, one after another, are joined at each of these in the same way, so that they are one
/// mesh again.
std::vector<JoinedParts>
groups_standing_together(const Scene& scene, const std::vector<std::vector<std::size_t>>& parts_of_meshes);

/// Appends the others' meshes to the first's, in its space; they are empty then. The first's transform must
/// have an inverse.
void join(Scene& scene, const JoinedParts& group);

} // namespace facetmill::optimize_stage
