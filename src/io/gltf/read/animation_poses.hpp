#pragma once
// The poses in which a simplified part is compared with its input: keys of animations, and morph targets.

#include "mesh/scene.hpp"

#include <memory>
#include <string>

namespace facetmill::io {

/// Poses of the skinned and morphed parts of a document.
class AnimationPoses {
  public:
    /// Samples at most `most` keys (at least 2) of all animations together, evenly. Throws malformed (E-GLTF)
    /// for a document whose animations or nodes cannot be read.
    AnimationPoses(const Document& document, std::size_t most);
    ~AnimationPoses();
    AnimationPoses(const AnimationPoses&) = delete;
    AnimationPoses& operator=(const AnimationPoses&) = delete;

    /// A pose of a part.
    struct Pose {
        std::string name;              ///< "animation 'walk' at 0.5 s", "morph target 2"
        std::vector<double> weights;   ///< of the morph targets
        std::vector<Transform> joints; ///< empty: no skin
    };
    /// The sampled poses of a part; empty if no animation moves it and it has no targets. Targets that no
    /// animation moves count alone, each with full weight, at most `most`. Throws the same error.
    [[nodiscard]] std::vector<Pose> of(const Part& part);

  private:
    class Tracks;
    std::unique_ptr<Tracks> tracks_;
    std::size_t most_;
};

/// The mesh in this pose: in the world for a skinned part, otherwise in its own space. Only positions,
/// normals and tangents change.
[[nodiscard]] Mesh posed_mesh(const Mesh& mesh, const AnimationPoses::Pose& pose);

} // namespace facetmill::io
