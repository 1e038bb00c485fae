#pragma once
// Several meshes simplified as a single mesh.

#include "geometry/simplify/simplify.hpp"

namespace facetmill {

// Meshes with coincident open borders: tiles, separated components, or the parts of a body.

/// A mesh and its transform to the world.
struct PlacedMesh {
    const Mesh* mesh;
    Transform to_world;
};

/// Boundary edges of different meshes whose ends have exactly the same world positions.
struct Contacts {
    /// Sets of two or more meshes connected by such edges; ascending, by the first mesh.
    std::vector<std::vector<std::size_t>> sets;
    /// [meshes][vertices] 1 for the ends of such edges; empty for a mesh without contacts.
    std::vector<std::vector<std::uint8_t>> shared;
};
/// O(n log n) in the meshes whose bounding boxes overlap; other meshes cost nothing.
[[nodiscard]] Contacts find_contacts(std::span<const PlacedMesh> meshes);

/// True if meshes of the same space can be merged for simplification: same attributes, and the same kind of
/// shading.
bool can_simplify_jointly(std::span<const Mesh* const> meshes, const SimplifySettings& settings);

/// Like simplify, or simplify_levels when settings has levels, for meshes that satisfy can_simplify_jointly.
/// The meshes are merged during the work, so that borders where they touch collapse identically on both
/// sides. Returns [levels][meshes]; without levels, one entry. Targets apply to the total. Counts are per
/// mesh; errors, reasons and changes are shared.
[[nodiscard]] std::vector<std::vector<SimplifyResult>> simplify_jointly(std::span<const Mesh* const> meshes,
                                                                        const SimplifySettings& settings);

} // namespace facetmill

namespace facetmill::simplification {

/// Merges the meshes and numbers the faces by the mesh that they belong to. Primitives stay numbers.
[[nodiscard]] Mesh joined(std::span<const Mesh* const> meshes);
/// Splits the result of the merged mesh into one result per mesh.
[[nodiscard]] std::vector<SimplifyResult> split_up(SimplifyResult all, std::span<const Mesh* const> meshes);

} // namespace facetmill::simplification
