#pragma once
// Points spread over a surface by its area, each computed on request.

#include "mesh/surface.hpp"

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace facetmill {

/// The k-th of `size` samples is in the k-th of as many equal parts of the area, taken triangle by triangle.
/// So the samples of a triangle are consecutive. They depend only on the surface, their number and the seed.
class AreaSamples {
  public:
    /// The surface must not change while samples are requested. Empty if the surface has no area.
    AreaSamples(const Surface& surface, std::size_t count, std::uint64_t seed);

    std::size_t size() const { return triangles_.size(); }
    Index triangle_of(std::size_t k) const { return triangles_[k]; }
    Vec3 point(std::size_t k) const { return on(triangles_[k]).point(k); }

    /// The samples of one triangle.
    struct Run {
        Index triangle;
        std::size_t begin, end;
    };
    /// The runs of all triangles with samples, in the given order of the triangles.
    std::vector<Run> runs(std::span<const Index> order) const;

    /// A triangle, to compute several of its samples.
    class OnTriangle {
      public:
        /// Sample k of Roberts' additive sequence in the plane, which fills large triangles more evenly than
        /// chance.
        Vec3 point(std::size_t k) const {
            double u = fraction(start_u_ + static_cast<double>(k) * 0.7548776662466927);
            double v = fraction(start_v_ + static_cast<double>(k) * 0.5698402909980532);
            if (u + v > 1) {
                u = 1 - u;
                v = 1 - v;
            }
            return corner_ + ab_ * u + ac_ * v;
        }

      private:
        friend AreaSamples;
        static double fraction(double x) { return x - std::floor(x); }
        Vec3 corner_, ab_, ac_;
        double start_u_, start_v_;
    };
    OnTriangle on(std::size_t triangle) const;

  private:
    void place_all(std::size_t count, const std::vector<double>& areas);

    const Surface& surface_;
    std::uint64_t seed_;
    double start_u_, start_v_;
    std::vector<Index> triangles_; ///< [samples] ascending
};

} // namespace facetmill
