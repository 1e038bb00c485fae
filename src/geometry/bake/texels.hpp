#pragma once
// The texels that the triangles of a mesh cover.

#include "mesh/mesh.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace facetmill::baking {

/// A point of the texture, in units of 2^-16 texels, so that edges are exact.
struct FixedPoint {
    std::int64_t x = 0, y = 0;
};
inline constexpr std::int64_t texel_unit = 65536;

/// A point of a triangle.
struct TexelPlace {
    Index triangle = none;
    Vec3 weights;
};

/// The triangles of a mesh in a square texture, sorted by bands of rows.
class TexelBands {
  public:
    static constexpr int rows = 8;

    /// mesh: triangles with TEXCOORD_0 within the unit square. samples: along each side of a texel.
    TexelBands(const Mesh& mesh, int size, int samples);

    std::size_t count() const { return begin_.size() - 1; }
    int first_row(std::size_t band) const { return static_cast<int>(band) * rows; }
    int row_count(std::size_t band) const { return std::min(rows, size_ - first_row(band)); }

    /// The places of the samples of a band: samples^2 for each texel, row by row. A texel without a covered
    /// sample has its first one on the nearest triangle that is less than a texel away.
    /// marks: receives for each triangle 1 if it has a texel, and 2 if it shares one.
    std::vector<TexelPlace> places(std::size_t band, std::vector<std::uint8_t>& marks) const;

    /// The corners of a triangle in texels.
    std::array<double, 6> corners(Index triangle) const;

  private:
    struct Samples;
    void cover(Samples& samples, Index triangle, std::vector<std::uint8_t>& marks) const;
    void border(Samples& samples, Index triangle) const;

    int size_, samples_;
    std::vector<FixedPoint> points_; ///< [corners]
    std::vector<std::size_t> begin_; ///< [bands + 1] offsets into triangles_
    std::vector<Index> triangles_;   ///< of each band, in order
};

} // namespace facetmill::baking
