#pragma once
// CGAL's clip of a closed surface by a plane, for comparison.

#include "mesh/mesh.hpp"

#include <memory>

namespace facetmill::bench {

class CgalClip {
  public:
    explicit CgalClip(const Mesh& triangles);
    ~CgalClip();
    /// Keeps what is behind the plane, with its cap (clip_volume).
    void clip(const Vec3& normal, const Vec3& through);
    std::size_t face_count() const;

  private:
    struct Own;
    std::unique_ptr<Own> own_;
};

} // namespace facetmill::bench
