#pragma once
// Judges of a simplification's shapes: how far they are from the mesh that came in.

#include "geometry/deviation/deviation.hpp"
#include "mesh/mesh.hpp"

namespace facetmill::simplification {

/// Judges shapes by their deviation from the mesh that came in, whose tree is built once.
class Judge {
  public:
    /// bound: in the mesh's units.
    Judge(const Mesh& from, double bound);

    const FaceTree& tree() const { return tree_; }
    /// Whether the deviation, as `deviation` would measure it, is within the bound; stops at the first sample
    /// beyond.
    bool within(const Mesh& mesh) const;
    double deviation(const Mesh& mesh) const;

  private:
    Surface surface_;
    FaceTree tree_;
    double bound_;
};

} // namespace facetmill::simplification
