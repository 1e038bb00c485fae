#pragma once
// Simplification of meshes whose open borders run along each other: tiles, separated pieces, the parts of one
// body.

#include "geometry/simplify/simplify.hpp"

#include <span>

namespace facetmill {

/// A mesh and where it stands.
struct PlacedMesh {
    const Mesh* mesh;
    Transform to_world;
};

/// Open edges of different meshes whose ends are at exactly the same places in the world.
struct Contacts {
    /// Sets of meshes that hang together by such edges, two or more each; ascending, by the first.
    std::vector<std::vector<std::size_t>> sets;
    /// [meshes][vertices] 1 for the ends of such edges; empty for a mesh that touches none.
    std::vector<std::vector<std::uint8_t>> shared;
};
/// O(n log n) for meshes whose boxes meet another's, else nothing.
Contacts find_contacts(std::span<const PlacedMesh> meshes);

/// Whether meshes of one space can be simplified as one: the same attributes, and shading of one kind.
bool fit_together(std::span<const Mesh* const> meshes, const SimplifySettings& settings);

/// As simplify, or simplify_levels when settings has levels, of meshes for which fit_together holds: they are
/// worked on as one, so that borders where they touch collapse on both sides alike. [levels][meshes]; without
/// levels there is one. Targets are those of all together; a mesh has its own counts and the errors, reasons
/// and fates of all.
std::vector<std::vector<SimplifyResult>> simplify_together(std::span<const Mesh* const> meshes,
                                                           const SimplifySettings& settings);

} // namespace facetmill
