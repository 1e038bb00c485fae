#pragma once
// CGAL's questions to a surface, for comparison in one run.

#include "mesh/mesh.hpp"

#include <memory>
#include <span>

namespace facetmill::bench {

class CgalSurface {
  public:
    /// Of a manifold, oriented triangle mesh.
    explicit CgalSurface(const Mesh& mesh);
    ~CgalSurface();

    /// Pairs of faces, by Polygon_mesh_processing::self_intersections with Parallel_tag.
    std::size_t self_intersections() const;
    /// Makes the AABB tree that the rest asks.
    void build_tree();
    /// The sum of the distances of the points, in parallel.
    double distances(std::span<const Vec3> points) const;
    /// How many of the segments between neighbours of the list meet the surface, in parallel.
    std::size_t met(std::span<const Vec3> points) const;

  private:
    struct Own;
    std::unique_ptr<Own> own_;
};

} // namespace facetmill::bench
