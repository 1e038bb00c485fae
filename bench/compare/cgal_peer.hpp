#pragma once
// CGAL's edge collapse, for comparison.

#include "mesh/mesh.hpp"

#include <memory>

namespace facetmill::bench {

class CgalPeer {
  public:
    explicit CgalPeer(const Mesh& mesh);
    ~CgalPeer();
    /// quadric: Garland and Heckbert; else the edge's length, placed at the midpoint.
    void simplify(double ratio, bool quadric);
    Mesh mesh() const;

  private:
    struct Own;
    std::unique_ptr<Own> own_;
};

} // namespace facetmill::bench
