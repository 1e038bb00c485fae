#pragma once
// A mesh projected for a footprint. Only crop uses it.

#include "geometry/crop/crop.hpp"

namespace facetmill {

/// Locates points by the requested rule.
class Inside {
  public:
    /// Throws a usage error (E-FOOTPRINT) when the rule needs a single convex ring and the footprint is not
    /// one.
    Inside(const Footprint& footprint, InsideBy by);
    polygon::PointLocation operator()(const Vec2& p) const;

  private:
    const Footprint& footprint_;
    InsideBy by_;
    std::vector<polygon::Ring> spans_;
    std::vector<Vec3> flat_;
};

/// The mean of a face's corners.
[[nodiscard]] inline Vec2 mean_of_corners(const std::vector<Vec2>& face) {
    Vec2 sum;
    for (const Vec2& p : face) sum = sum + (p - face[0]);
    return face[0] + sum * (1 / static_cast<double>(face.size()));
}

class CropView {
  public:
    CropView(const Footprint& footprint, const CropSettings& settings)
        : footprint_(footprint), settings_(settings), inside_(footprint, settings.inside_by) {}

    /// With snap: how far 32-bit floats that count as on the outline may be off it along both coordinates,
    /// and how far other points may be (64 units of a double's last place).
    Vec2 snap, rounding;

    const Footprint& footprint() const { return footprint_; }
    const CropSettings& settings() const { return settings_; }
    Vec2 seen(const Vec3& p) const { return seen_along(settings_.axis, settings_.to_world.point(p)); }
    polygon::PointLocation place(const Vec2& p) const { return inside_(p); }
    bool kept(polygon::PointLocation place) const {
        return (place == polygon::PointLocation::inside) == (settings_.keep == polygon::Keep::inside);
    }

    /// Projects the corners of a face.
    void gather(const Mesh& mesh, Index f, std::vector<Vec2>& face) const;
    /// The location of a point in the middle of a face. In a concave face, the point is in the largest
    /// triangle. An edge-on face along the outline belongs to the side that it faces away from. convex: the
    /// face is known to be convex within rounding.
    polygon::PointLocation middle(const Mesh& mesh, Index f, bool convex = false) const;
    /// Calls visit(segment, meeting) for the segments near a face until it returns false.
    template <class Visit>
    void meetings(const std::vector<Vec2>& face, Visit&& visit) const {
        polygon::RingTree::Bounds box;
        for (const Vec2& p : face) box.add(p);
        footprint_.tree().query(box, [&](Index i) {
            const auto& e = footprint_.tree().edges()[i];
            return visit(i, meeting(face, e.a, e.b));
        });
    }

  private:
    bool is_on_segment(const std::vector<Vec2>& face) const;
    bool is_on_outline(const Mesh& mesh, Index f, const Vec2& mean, const std::vector<Vec2>& face) const;
    polygon::PointLocation settle(polygon::PointLocation place, const Mesh& mesh, Index f) const;

    const Footprint& footprint_;
    const CropSettings& settings_;
    Inside inside_;
};

} // namespace facetmill
