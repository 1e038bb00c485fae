#pragma once
// Rays from the target to the source.

#include "geometry/bake/source_values.hpp"
#include "geometry/spatial/face_tree.hpp"

namespace facetmill::baking {

/// Where a point of the target meets the source.
struct Projection {
    SourcePlace place;
    Vec3 point;
    double height = 0; ///< along the direction
    bool missed = false;
};

/// Finds points of the source. Its members must outlive it.
class Projector {
  public:
    Projector(const FaceTree& tree, const SourceReader& reader, double distance, bool any_side)
        : tree_(tree), reader_(reader), distance_(distance), any_side_(any_side) {}

    /// The hit nearest to p among those along the direction and against it; otherwise the nearest point of
    /// the source.
    Projection operator()(const Vec3& p, const Vec3& direction, Index& hint) const;

  private:
    const FaceTree& tree_;
    const SourceReader& reader_;
    double distance_;
    bool any_side_;
};

/// Whether a ray hits the surface between these distances. Rays along edges may slip through.
[[nodiscard]] bool is_blocked(const FaceTree& tree, const Vec3& from, const Vec3& direction, double near,
                              double far);

/// The distance at which a ray hits the surface, beyond `near`; infinity if it hits nothing.
[[nodiscard]] double distance_to_surface(const FaceTree& tree, const Vec3& from, const Vec3& direction,
                                         double near);

} // namespace facetmill::baking
