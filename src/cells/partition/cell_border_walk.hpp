#pragma once
// The cells of a mesh one after another, and the faces at their borders where cells come together: so that
// each vertex and edge is looked at once, where all of its faces are known.

#include "cells/partition/partition.hpp"
#include "geometry/inspect/connectivity.hpp"

namespace facetmill::cells {

class RimVisitor {
  public:
    virtual ~RimVisitor() = default;
    /// Each cell as it is read, with all of its faces. Attributes that it gives the mesh go with the faces.
    virtual void read(Cell& cell) = 0;
    /// The faces of two nodes that have become one.
    virtual void meet(Mesh&) {}
    /// Faces that are known together. turns: [vertices] see connectivity_of
    virtual void look(const Mesh& mesh, const std::vector<Turn>& turns) = 0;
    /// What it takes for each face that it looks at, the face included.
    virtual std::uint64_t bytes_per_face() const { return 200; }
};

/// Goes up the tree: what goes up are only the faces that have a vertex which cells outside of the node
/// share. The mesh has no attributes but those that the visitor gave it. Throws output (E-SCRATCH); limit
/// (E-MEMORY) where the faces at borders are more than memory takes, as those of one vertex that a million
/// faces have.
void walk_cell_borders(const Partition& partition, const CellResources& means, RimVisitor& visitor);

} // namespace facetmill::cells
