#pragma once
// CGAL's own answers, for comparison.

#include "geometry/polygon/polygon.hpp"
#include "mesh/mesh.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace facetmill::oracle {

/// The pairs of faces that CGAL's Polygon_mesh_processing::self_intersections finds on an edge-manifold,
/// oriented triangle mesh, each (lower, higher), sorted.
std::vector<std::pair<Index, Index>> self_intersections(const Mesh& mesh);

/// The side of d relative to the plane through a, b, c, in rational numbers: 1 on the side of (b - a) x (c -
/// a).
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// An upper bound of the largest distance from a point of the first mesh to the second, no more than `error`
/// above it (CGAL's bounded_error_Hausdorff_distance). Edge-manifold triangle meshes.
double hausdorff_distance(const Mesh& from, const Mesh& to, double error);

/// The union of two closed meshes by CGAL's corefinement. Edge-manifold triangle meshes that do not intersect
/// themselves.
Mesh union_of(const Mesh& a, const Mesh& b);
/// The difference, in the same way.
Mesh difference_of(const Mesh& a, const Mesh& b);

/// CGAL's Polygon_2.
class Polygon {
  public:
    explicit Polygon(polygon::Ring ring);
    ~Polygon();
    double area() const;
    bool is_simple() const;
    /// Requires a simple polygon, as do the following functions.
    bool is_convex() const;
    int orientation() const;
    /// 1: inside, 0: on the boundary, -1: outside.
    int side(const Vec2& p) const;

  private:
    struct Own;
    std::unique_ptr<Own> own_;
};

/// CGAL's AABB tree over the triangles of a mesh.
class Tree {
  public:
    explicit Tree(const Mesh& mesh);
    ~Tree();
    double distance(const Vec3& p) const;
    /// How many triangles the segment meets, exactly; touching counts.
    std::size_t met_by(const Vec3& from, const Vec3& to) const;

  private:
    struct Own;
    std::unique_ptr<Own> own_;
};

} // namespace facetmill::oracle
