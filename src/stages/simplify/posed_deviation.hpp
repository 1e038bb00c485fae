#pragma once
// The deviation of skinned and morphed parts in the poses of their animations.

#include "geometry/simplify/simplify.hpp"
#include "io/gltf/read/animation_poses.hpp"

#include <map>

namespace facetmill::simplify_stage {

/// Keeps the meshes of skinned and morphed parts before they are simplified, and compares later.
class PosedParts {
  public:
    /// selected: [parts].
    PosedParts(const Scene& scene, const std::vector<std::uint8_t>& selected);

    /// The deviation of the result from part `number` of the scene, in at most 32 poses, and fewer for large
    /// meshes. None if the part has no poses.
    [[nodiscard]] std::optional<PosedDeviation> compare(const Scene& scene, std::size_t number,
                                                        const Part& result);

  private:
    std::map<std::size_t, Mesh> before_;
    std::map<int, io::AnimationPoses> poses_; ///< by document
};

} // namespace facetmill::simplify_stage
