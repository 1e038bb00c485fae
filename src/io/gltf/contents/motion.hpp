#pragma once
// How far the keys of animations may be off before a viewer shows it.

#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/nodes.hpp"

#include <set>
#include <string>
#include <vector>

namespace facetmill::io::gltf {

/// Limits for the keys of each node, such that no vertex of the document moves by more than a length in any
/// pose. The length is a ratio of the diagonal of all meshes at rest; without meshes, of all nodes. It is
/// divided evenly among the properties that move a vertex and differ between keys. Bounds are to first order
/// in the errors. Rotations stay within 0.1 degrees and scales within 0.001, whatever they move. Nodes above
/// cameras, instances or contents of unknown extensions have no tolerance.
class MotionLimits {
  public:
    /// Throws malformed when nodes, animations or skins are invalid.
    MotionLimits(Source& source, const std::vector<NodeFrame>& frames, double ratio);

    /// The limit for a property of a node: a length in the space of its parent (translation), an angle in
    /// radians (rotation), the length of a difference of two scales (scale), the sum of the differences of
    /// the weights (weights). 0 for other properties, and for properties that no key changes.
    double of(std::size_t node, const std::string& path) const;

  private:
    struct Node {
        double move = 0, scale = 1; ///< the largest translation and scale of any key or at rest
        double reach = 0;           ///< the largest distance of a vertex below from the node, in its space
        double parent_stretch = 1;  ///< from the parent's space to the world
        double morph = 0;           ///< the largest displacement of a target, in the space of the node
        int own = 0, above = 0, below = 0; ///< moving properties
    };

    struct Joint {
        std::size_t node;
        Transform from_mesh; ///< the inverse bind matrix
    };

    void see_animations(Source& source);
    void see_keys(const AnimatedProperty& property, const Attribute& keys);
    void see_meshes(Source& source);
    void see_skins(Source& source);
    void see_skinned(Source& source, const JsonCursor& primitive, const std::vector<Joint>& joints,
                     double morph);
    void see_hierarchy(const std::vector<NodeFrame>& frames);
    double share(std::size_t node) const;

    std::vector<Node> nodes_;
    std::set<std::pair<std::size_t, std::string>> moving_; ///< properties that differ between keys
    double length_;                                        ///< in the world
};

} // namespace facetmill::io::gltf
