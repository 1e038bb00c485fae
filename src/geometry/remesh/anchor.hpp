#pragma once
// The input surface and its feature lines, on which all vertices stay.

#include "geometry/remesh/working_mesh.hpp"
#include "geometry/spatial/closest_point.hpp"

namespace facetmill::remeshing {

/// A point of the input.
struct Spot {
    Vec3 point;
    double size = 0;   ///< the intended edge length at the point
    Index hint = none; ///< triangle of the tree
    Vec3 normal;       ///< of the face; zero on a line
};

class Anchor {
  public:
    /// start: the input as laid out, with sizes. tree: over all faces of the input mesh.
    Anchor(const Mesh& input, const FaceTree& tree, const WorkingMesh& start);

    /// The nearest point of the surface. None if p is not finite.
    [[nodiscard]] std::optional<Spot> on_surface(const Vec3& p, Index hint) const;
    /// The nearest point of a feature line. None without lines.
    [[nodiscard]] std::optional<Spot> on_lines(const Vec3& p) const;
    [[nodiscard]] const FaceTree& tree() const { return tree_; }

  private:
    const Mesh& input_;
    const FaceTree& tree_;
    std::vector<double> sizes_; ///< [vertices of the input]
    double size_;               ///< the size everywhere; 0 if sizes differ
    std::vector<Index> ends_;   ///< [2 lines] vertices of feature edges
    FaceTree lines_;
};

} // namespace facetmill::remeshing
