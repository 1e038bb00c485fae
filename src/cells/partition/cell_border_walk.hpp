#pragma once
// Visits the cells of a mesh in order, and the faces at their borders where cells meet. Each vertex and edge
// is thus visited once, when all of its faces are known.

#include "cells/partition/partition.hpp"
#include "geometry/inspect/connectivity.hpp"

namespace facetmill::cells {

class RimVisitor {
  public:
    virtual ~RimVisitor() = default;
    /// Called for each cell with all of its faces. Attributes that it adds to the mesh stay with the faces.
    virtual void read(Cell& cell) = 0;
    /// Called for the merged faces of two nodes.
    virtual void meet(Mesh&) {}
    /// Called for faces that are known together. turns: [vertices] see connectivity_of
    virtual void look(const Mesh& mesh, const std::vector<Turn>& turns) = 0;
    /// Memory per visited face in bytes, including the face.
    virtual std::uint64_t bytes_per_face() const { return 200; }
};

/// Walks up the tree. Only faces with a vertex that cells outside the node share move up, with only the
/// attributes that the visitor added. Throws an output error (E-SCRATCH), and a limit error (E-MEMORY) if
/// the faces at borders exceed memory, for example at a vertex of a million faces.
void walk_cell_borders(const Partition& partition, const CellResources& means, RimVisitor& visitor);

} // namespace facetmill::cells
