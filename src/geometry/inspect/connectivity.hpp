#pragma once
// Finds edges, boundary, manifoldness and orientation from the faces around each vertex, in a single pass
// without an edge table.

#include "mesh/mesh.hpp"

#include <cstdint>
#include <span>

namespace facetmill {

/// The part of Properties that follows from connectivity alone; Properties documents each member.
struct Connectivity {
    std::int64_t edges = 0, boundary_edges = 0, boundary_loops = 0, isolated_vertices = 0;
    std::int64_t uncancelled_edges = 0; ///< edges at which the directions of the faces do not cancel
    std::int64_t crowded_edges = 0;     ///< edges with more than two faces
    std::int64_t disagreeing_edges =
        0; ///< edges at which more than one face is left after pairing opposite faces
    std::int64_t non_manifold_vertices =
        0; ///< vertices whose faces form several fans, because edges do not link them all
    std::int64_t duplicate_triangles =
        0; ///< of an all-triangle mesh: triangles of three vertices seen before

    bool is_manifold() const { return crowded_edges == 0 && non_manifold_vertices == 0; }
};

struct Properties;
/// Sets the properties that follow from these numbers: edges, boundary edges, closed, manifold, oriented.
void set_connectivity(Properties& p, const Connectivity& c);

/// The state of a vertex that several parts of a larger mesh share, if the parts are counted one after
/// another.
enum class Turn : std::uint8_t {
    later, ///< some of its faces are missing in this part
    now,   ///< all of its faces are present
    before ///< an earlier part counted it
};

/// Counts the whole mesh. O(corners log(faces at a vertex)), parallel. The result does not depend on the
/// number of threads.
[[nodiscard]] Connectivity connectivity_of(const Mesh& mesh);
/// Counts the vertices with Turn::now, and edges with such a vertex and no vertex with Turn::before. Does
/// not count loops, isolated vertices and duplicates. turns: [vertices].
[[nodiscard]] Connectivity connectivity_of(const Mesh& mesh, std::span<const Turn> turns);

} // namespace facetmill
