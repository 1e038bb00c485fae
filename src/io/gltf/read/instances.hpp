#pragma once
// EXT_mesh_gpu_instancing: one node that has its mesh at many places.

#include "io/bytes.hpp"
#include "io/codec.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/nodes.hpp"
#include "io/gltf/numbers/quantise.hpp"

namespace facetmill::io::gltf {

inline constexpr const char* instancing_extension = "EXT_mesh_gpu_instancing";

/// The instances of a node, whose places are seen from the node: what the extension stores of them.
struct Instances {
    std::size_t count = 0;
    std::optional<Attribute> translation, rotation, scale; ///< without those that it leaves out
    std::vector<std::string> others;                       ///< attributes that say nothing of places

    Transform place(std::size_t i) const;
    /// Of the instance with the greatest scale, the first of these, so that an error that is measured there
    /// is no less elsewhere; of those that have a volume, the identity when none has.
    Transform largest_place() const;
};

/// None for a node that places its mesh once: without the extension or its attributes, without a mesh, with a
/// skin. Throws malformed (E-GLTF) for attributes of different counts or types.
std::optional<Instances> instances_of(Source& source, std::size_t node);

/// Parts of nodes with instances stand where the largest of these does.
void stand_at_largest_instances(Source& source, const std::vector<NodeFrame>& frames,
                                std::vector<Placement>& placements);

/// The translations, in float32, of the instances of a mesh whose vertices count steps of a grid, at a node
/// that is scaled by the step: what is n steps from the grid's origin stands where it stood. None when one is
/// too large for float32.
std::optional<Attribute> translations_on_grid(const Instances& given, const PositionGrid& grid);

/// Gives each instance of EXT_mesh_gpu_instancing a node of its own, a child of the one that had them all,
/// whose mesh it has. Attributes of instances other than their places are dropped, and said (W-INSTANCING).
/// Throws malformed (E-GLTF), limit (E-MEMORY).
void expand_instances(Json& document, const std::vector<Bytes>& buffers, ReadLog& log);

} // namespace facetmill::io::gltf
