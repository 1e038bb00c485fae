#pragma once
// Determines the vertices that a shaping stage may move, and how far.

#include "mesh/scene.hpp"

namespace facetmill {

struct MaskSettings {
    std::string material = {};              ///< name or glob of materials; empty: any
    std::optional<std::int64_t> group = {}; ///< number in the face attribute `group`
    std::string attribute = {}; ///< name of an attribute; its first number, 0 to 1, is the share of the move
    bool invert = false;        ///< selects the other vertices, or the rest of the share

    bool any() const { return !material.empty() || group || !attribute.empty(); }
};

/// For each vertex a share from 0 (stays) to 1 (moves). The share is 1 if all its faces have the material
/// and the group, times the attribute. The attribute counts at the vertex, or as the least over its wedges
/// or faces. Normalised integers count as fractions; other values are clamped to 0 .. 1. The face condition
/// is true for vertices without faces. Empty settings give an empty vector: all 1. Throws a stage error
/// (E-MASK) when the mesh has no such attribute or group attribute.
[[nodiscard]] std::vector<double> vertex_mask(const Part& part, const Scene& scene,
                                              const MaskSettings& settings);

/// Sets the share of each vertex of a cap to 0. Caps are the faces that the face attribute `cut_id` numbers,
/// as clip, crop and tile do. Empty shares (all 1) stay empty when the mesh has no caps.
void hold_caps(const Mesh& mesh, std::vector<double>& shares);

} // namespace facetmill
