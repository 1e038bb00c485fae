#pragma once
// Cuts the faces of a mesh by the planes of a stack into pieces of contours. Only section uses it.

#include "geometry/section/section.hpp"

#include <algorithm>

namespace facetmill {

/// The crossing of a plane and an edge of the mesh, as endpoints in index order.
struct EdgeKey {
    Index low = 0, high = 0;
    std::uint64_t bits() const { return std::uint64_t{low} << 32 | high; }
};

/// A piece of a contour across a face. It runs from the edge where the face descends through the plane to
/// the edge where it ascends. Viewed against the plane's normal, the face's back is on the left.
struct Piece {
    Index plane;
    EdgeKey from, to;
};

/// The planes of the stack in the mesh's space.
class StackPlanes {
  public:
    explicit StackPlanes(const SectionSettings& s) : local_(pulled_back(s.plane, s.to_world)) {
        const double scale = length(s.plane.normal);
        for (const double h : s.heights) offsets_.push_back(local_.offset - h * scale);
        local_.offset = 0;
        if (!s.memory || s.memory->entries.empty()) return;
        for (std::size_t k = 0; k < size(); ++k) known_.push_back(s.memory->find(plane(k)));
    }
    std::size_t size() const { return offsets_.size(); }
    /// Returns 0 also for points known to be on the plane.
    double side_of(std::size_t k, const Vec3& p) const {
        const double s = side(plane(k), p);
        const CutMemory::Entry* known = known_.empty() ? nullptr : known_[k];
        return known && known->has(p, side(known->plane, p)) ? 0 : s;
    }
    /// The number of planes that the point is on or above. Exact signs decide; the search in doubles only
    /// gives the starting point.
    Index level(const Vec3& p) const {
        const double s = side(local_, p);
        auto k = static_cast<std::size_t>(
            std::partition_point(offsets_.begin(), offsets_.end(), [&](double o) { return s + o >= 0; }) -
            offsets_.begin());
        while (k < size() && side_of(k, p) >= 0) ++k;
        while (k > 0 && side_of(k - 1, p) < 0) --k;
        return static_cast<Index>(k);
    }

  private:
    Plane plane(std::size_t k) const {
        Plane plane = local_;
        plane.offset = offsets_[k];
        return plane;
    }

    Plane local_;
    std::vector<double> offsets_;                ///< descending
    std::vector<const CutMemory::Entry*> known_; ///< [planes] memory entry, or null; empty: no known points
};

/// The pieces of all faces, ordered by plane, then face. plane: in the mesh's space. Throws a limit error
/// (E-SECTION).
[[nodiscard]] std::vector<Piece> pieces_of(const Mesh& mesh, const StackPlanes& stack, const Plane& plane);

} // namespace facetmill
