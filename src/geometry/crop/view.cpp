#include "geometry/crop/view.hpp"

#include "base/error.hpp"
#include "base/math/predicates.hpp"
#include "geometry/cut/cut.hpp"
#include "geometry/polygon/triangulate_rings.hpp"

#include <algorithm>

namespace facetmill {

using polygon::PointLocation;

Inside::Inside(const Footprint& footprint, InsideBy by)
    : footprint_(footprint), by_(by), spans_(footprint.spans()) {
    if (by != InsideBy::half_planes && by != InsideBy::angles_3d) return;
    if (spans_.size() != 1 || !polygon::is_convex(spans_[0]))
        throw Error(ErrorKind::usage, "E-FOOTPRINT",
                    "this test for points needs a footprint of one convex ring",
                    "use inside_by: crossings, which accepts any footprint");
    for (const Vec2& p : spans_[0]) flat_.push_back({p.x, p.y, 0});
}

PointLocation Inside::operator()(const Vec2& p) const {
    const PointLocation place = footprint_.locate(p); // all rules would depend on rounding on the outline
    if (by_ == InsideBy::crossings || place > PointLocation::inside) return place;
    if (by_ == InsideBy::half_planes) return polygon::locate_convex(p, spans_[0]);
    const bool inside = by_ == InsideBy::angles ? polygon::inside_by_angles(p, spans_)
                                                : polygon::inside_by_angles({p.x, p.y, 0}, flat_);
    return inside ? PointLocation::inside : PointLocation::outside;
}

void CropView::gather(const Mesh& mesh, Index f, std::vector<Vec2>& face) const {
    face.clear();
    for (const Index w : mesh.face_wedges(f)) face.push_back(seen(mesh.positions[mesh.vertex_of_wedge(w)]));
}

PointLocation CropView::middle(const Mesh& mesh, Index f, bool convex) const {
    std::vector<Vec2> face;
    gather(mesh, f, face);
    const polygon::Ring ring = face;
    Vec2 sum;
    if (!convex && face.size() > 3 && !polygon::is_convex(ring) && polygon::orientation(ring) != 0) {
        const auto t = polygon::triangulate_rings(polygon::Rings(&ring, 1));
        double most = -1;
        for (const auto& abc : t.triangles) {
            if (*std::max_element(abc.begin(), abc.end()) >= face.size())
                continue; // the crossings are only rounded
            const double area = cross(face[abc[1]] - face[abc[0]], face[abc[2]] - face[abc[0]]);
            if (area > most) {
                most = area;
                sum = face[abc[0]] + face[abc[1]] + face[abc[2]];
            }
        }
        if (most >= 0) return settle(inside_(sum * (1.0 / 3)), mesh, f);
    }
    const Vec2 mean = mean_of_corners(face);
    return settle(is_on_outline(mesh, f, mean, face) ? PointLocation::on_edge : inside_(mean), mesh, f);
}

/// True if the face is exactly on a segment, edge-on.
bool CropView::is_on_segment(const std::vector<Vec2>& face) const {
    for (std::size_t i = 2; i < face.size(); ++i)
        if (polygon::turn(face[0], face[i - 1], face[i]) != 0) return false;
    bool found = false;
    footprint_.tree().query({face[0].x, face[0].y, face[0].x, face[0].y}, [&](Index i) {
        const auto& e = footprint_.tree().edges()[i];
        const auto bounds = polygon::RingTree::bounds(e);
        found = std::all_of(face.begin(), face.end(), [&](const Vec2& p) {
            return bounds.meets({p.x, p.y, p.x, p.y}) &&
                   orientation_2d(e.a.x, e.a.y, e.b.x, e.b.y, p.x, p.y) == 0;
        });
        return !found;
    });
    return found;
}

/// True if the face is on the outline, with float rounding allowed for float corners. A face that connects
/// different segments is not.
bool CropView::is_on_outline(const Mesh& mesh, Index f, const Vec2& mean,
                             const std::vector<Vec2>& face) const {
    if (is_on_segment(face)) return true;
    if (rounding == Vec2{}) return false;
    const auto on = [&](const Vec2& p, const Vec2& distance) {
        bool found = false;
        footprint_.near(p, distance, [&](Index) {
            found = true;
            return false;
        });
        return found;
    };
    const Vec2 most{std::max(snap.x, rounding.x), std::max(snap.y, rounding.y)};
    if (!on(mean, most)) return false;
    const auto corners = mesh.face_wedges(f);
    Vec2 widest = rounding;
    for (std::size_t i = 0; i < face.size(); ++i) {
        const bool rounded = is_float32(mesh.positions[mesh.vertex_of_wedge(corners[i])]);
        if (!on(face[i], rounded ? most : rounding)) return false;
        if (rounded) widest = most;
    }
    return on(mean,
              widest); // all corners may be on the outline although the mean is not
}

PointLocation CropView::settle(PointLocation place, const Mesh& mesh, Index f) const {
    if (place <= PointLocation::inside) return place;
    std::vector<Vec3> corners;
    for (const Index w : mesh.face_wedges(f))
        corners.push_back(settings_.to_world.point(mesh.positions[mesh.vertex_of_wedge(w)]));
    const Vec3 n = polygon::area_vector(corners);
    const Vec2 out = seen_along(settings_.axis, n), at = seen_along(settings_.axis, corners[0]);
    // Chooses the segment most parallel to the face, among segments that may contain it.
    double least = HUGE_VAL;
    bool inside = true;
    const double size = std::max({std::fabs(at.x), std::fabs(at.y), 1e-300});
    for (double margin = std::max({snap.x, snap.y, 16 * 2.220446049250313e-16 * size});
         least == HUGE_VAL && std::isfinite(margin); margin *= 16)
        footprint_.near(at, {margin, margin}, [&](Index i) {
            const Vec2 d = footprint_.tree().edges()[i].b - footprint_.tree().edges()[i].a;
            const double along = std::fabs(dot(d, out)) / (length(d) * length(out));
            if (along < least || least == HUGE_VAL) {
                least = along;
                inside = cross(d, out) < 0;
            }
            return true;
        });
    return inside ? PointLocation::inside : PointLocation::outside;
}

} // namespace facetmill
