#pragma once
// Rays along the coordinate axes, decided exactly: which faces they cross, and how often faces wind around a
// point.

#include "geometry/box_tree.hpp"
#include "mesh/mesh.hpp"

#include <array>

namespace facetmill {

/// A ray along an axis from a point, moved aside by less than any distance: a ray through an edge or a vertex
/// crosses as many faces as one beside it, always on the same side, so closed surfaces are counted right.
/// Faces are taken as their triangles (mesh/triangulated); the others, those with coordinates that are not
/// finite, are never crossed.
class AxisRays {
  public:
    explicit AxisRays(const Mesh& mesh);

    /// Calls hit(face, way) for every triangle that the ray from p crosses: forward along the axis or back.
    /// way is 1 where the ray leaves through the front of the face and -1 where it enters; p itself is not on
    /// the ray.
    template <class Hit>
    void visit(const Vec3& p, std::size_t axis, bool forward, Hit&& hit) const {
        Box ray;
        ray.add(p);
        (forward ? ray.max : ray.min)[axis] = forward ? HUGE_VAL : -HUGE_VAL;
        tree_.visit(ray, [&](Index t) {
            if (const int way = crossing(t, p, axis, forward)) hit(face_of(t), way);
        });
    }

  private:
    int crossing(Index triangle, const Vec3& p, std::size_t axis, bool forward) const;
    Index face_of(Index t) const { return parent_.empty() ? t : parent_[t]; }

    std::vector<std::array<Vec3, 3>> triangles_;
    std::vector<Index> parent_;
    BoxTree tree_{{}};
};

} // namespace facetmill
