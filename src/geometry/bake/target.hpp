#pragma once
// The surface that gets textures.

#include "geometry/bake/source_values.hpp"

namespace facetmill::baking {

/// A point of the target with its frames.
struct TargetPoint {
    Vec3 position;
    Vec3 direction;                  ///< of the ray, unit length: the smooth normal
    Vec3 normal, tangent, bitangent; ///< the tangent space as viewers have it
};

/// Reads points. The mesh must outlive it.
class TargetReader {
  public:
    explicit TargetReader(const Mesh& mesh);

    TargetPoint at(Index triangle, const Vec3& weights) const;
    /// The change of the position from texel to texel. corners: of the triangle, in texels.
    TexelSteps steps(Index triangle, const std::array<double, 6>& corners) const;

  private:
    const Mesh& mesh_;
    FloatColumn normals_, tangents_;
    std::vector<Vec3> directions_; ///< [vertices] area-weighted normals, not scaled
};

/// The coordinates of a unit vector in the tangent space, unit length; (0, 0, 1) if the space is flat.
[[nodiscard]] Vec3 in_tangent_space(const TargetPoint& point, const Vec3& v);

} // namespace facetmill::baking
