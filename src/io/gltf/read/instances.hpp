#pragma once
// EXT_mesh_gpu_instancing: a node with many instances of its mesh.

#include "io/bytes.hpp"
#include "io/codec.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/nodes.hpp"
#include "io/gltf/numbers/quantise.hpp"

namespace facetmill::io::gltf {

/// Numbers the instances of the same node, so it moves with them.
inline constexpr const char* instance_features = "EXT_instance_features";

/// The stored instances of a node, relative to the node.
struct Instances {
    std::size_t count = 0;
    std::optional<Attribute> translation, rotation, scale; ///< empty if the extension omits them
    std::vector<std::string> others;                       ///< attributes other than the transform

    Transform place(std::size_t i) const;
    /// The first instance with the greatest scale, so that an error measured there is a bound for all.
    /// Instances without volume are ignored. The identity if all instances are ignored.
    Transform largest_place() const;
};

/// The instances of a node. None for a node that places its mesh once: without the extension or its
/// attributes, without a mesh, or with a skin. Throws a malformed-input error (E-GLTF) for attributes of
/// different counts or types.
[[nodiscard]] std::optional<Instances> instances_of(Source& source, std::size_t node);

/// Moves parts of nodes with instances to their largest instance.
void stand_at_largest_instances(Source& source, const std::vector<NodeFrame>& frames,
                                std::vector<Placement>& placements);

/// The float32 translations of instances after the mesh's positions became grid steps and the node was scaled
/// by the step. Every point keeps its position. None if a translation is too large for float32.
[[nodiscard]] std::optional<Attribute> translations_on_grid(const Instances& given, const PositionGrid& grid);

/// Replaces each instance of EXT_mesh_gpu_instancing by a child node with the mesh. Other attributes of
/// instances are dropped with a warning (W-INSTANCING). Throws a malformed-input error (E-GLTF), a limit
/// error (E-MEMORY).
void expand_instances(Json& document, const std::vector<Bytes>& buffers, ReadLog& log);

} // namespace facetmill::io::gltf
