#pragma once
// Several meshes as one.

#include "geometry/simplify/simplify.hpp"

namespace facetmill {

// Meshes whose open borders run along each other: tiles, separated components, the parts of one body.

/// A mesh and where it stands.
struct PlacedMesh {
    const Mesh* mesh;
    Transform to_world;
};

/// Boundary edges of different meshes whose ends are at exactly the same places in the world.
struct Contacts {
    /// Sets of meshes that hang together by such edges, two or more each; ascending, by the first.
    std::vector<std::vector<std::size_t>> sets;
    /// [meshes][vertices] 1 for the ends of such edges; empty for a mesh that touches none.
    std::vector<std::vector<std::uint8_t>> shared;
};
/// O(n log n) for meshes whose boxes meet another's, else nothing.
Contacts find_contacts(std::span<const PlacedMesh> meshes);

/// Whether meshes of one space can be simplified as one: the same attributes, and shading of one kind.
bool can_simplify_jointly(std::span<const Mesh* const> meshes, const SimplifySettings& settings);

/// As simplify, or simplify_levels when settings has levels, of meshes for which can_simplify_jointly holds:
/// they are worked on as one, so that borders where they touch collapse on both sides alike.
/// [levels][meshes]; without levels there is one. Targets are those of all together; a mesh has its own
/// counts and the errors, reasons and changes of all.
std::vector<std::vector<SimplifyResult>> simplify_jointly(std::span<const Mesh* const> meshes,
                                                          const SimplifySettings& settings);

} // namespace facetmill

namespace facetmill::simplification {

/// All in one, the faces numbered by where they are from. Primitives stay numbers.
Mesh joined(std::span<const Mesh* const> meshes);
/// What became of each mesh, from what became of all.
std::vector<SimplifyResult> split_up(SimplifyResult all, std::span<const Mesh* const> meshes);

} // namespace facetmill::simplification
