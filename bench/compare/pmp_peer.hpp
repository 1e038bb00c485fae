#pragma once
// PMP's midpoint split and smoothing of a triangle mesh, for comparison.

#include <cstdint>
#include <memory>
#include <vector>

namespace facetmill::bench {

class PmpPeer {
  public:
    /// `points` holds x, y, z of each vertex, `corners` three vertices of each face.
    PmpPeer(const std::vector<double>& points, const std::vector<std::uint32_t>& corners);
    ~PmpPeer();
    void split_midpoint();
    void smooth(unsigned iterations);
    std::size_t face_count() const;

  private:
    struct Own;
    std::unique_ptr<Own> own_;
};

} // namespace facetmill::bench
