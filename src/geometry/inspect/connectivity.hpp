#pragma once
// Properties of the faces around each vertex: edges, boundary, manifoldness, orientation, in one pass and
// without an edge table.

#include "mesh/mesh.hpp"

#include <cstdint>
#include <span>

namespace facetmill {

/// The part of Properties that follows from connectivity alone; Properties documents each member.
struct Connectivity {
    std::int64_t edges = 0, boundary_edges = 0, boundary_loops = 0, isolated_vertices = 0;
    std::int64_t uncancelled_edges = 0; ///< where the directions of the faces do not cancel
    std::int64_t crowded_edges = 0;     ///< with more than two faces
    std::int64_t disagreeing_edges = 0; ///< where more than one face is left when opposite ones are paired
    std::int64_t non_manifold_vertices = 0; ///< whose faces form several fans: edges do not link them all
    std::int64_t duplicate_triangles =
        0; ///< of an all-triangle mesh: triangles of three vertices seen before

    bool is_manifold() const { return crowded_edges == 0 && non_manifold_vertices == 0; }
};

struct Properties;
/// The properties that these numbers are or decide: edges, boundary edges, closed, manifold, oriented.
void set_connectivity(Properties& p, const Connectivity& c);

/// The state of a vertex that a mesh shares with others when the parts of a larger mesh are counted one after
/// another.
enum class Turn : std::uint8_t {
    later, ///< not all of its faces are here
    now,   ///< all are
    before ///< it was counted
};

/// Counts all of it. O(corners log(faces at a vertex)), parallel, the same for any number of threads.
[[nodiscard]] Connectivity connectivity_of(const Mesh& mesh);
/// The vertices whose turn it is, and edges that have one of these and none of before. Loops, isolated
/// vertices and duplicates are not counted. turns: [vertices].
[[nodiscard]] Connectivity connectivity_of(const Mesh& mesh, std::span<const Turn> turns);

} // namespace facetmill
