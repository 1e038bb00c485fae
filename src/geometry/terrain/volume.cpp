#include "base/math/predicates.hpp"
#include "geometry/polygon/triangulate_rings.hpp"
#include "geometry/spatial/box_tree.hpp"
#include "geometry/terrain/terrain.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace facetmill {

namespace {

using polygon::RingTree;
using SeenTriangle = std::array<Vec3, 3>;

Vec2 in_plane(const Vec3& p) { return {p.x, p.y}; }

/// A convex piece of a triangle, anticlockwise in the plane. z is the surface's height.
using SeenPiece = std::vector<Vec3>;

/// The side of a line: its exact sign, and the size of the rounded determinant.
struct LineSide {
    int sign = 0;
    double size = 0;
};

LineSide line_side(const Vec2& a, const Vec2& b, const Vec3& p) {
    return {polygon::turn(a, b, in_plane(p)), std::fabs(cross(b - a, in_plane(p) - a))};
}

/// Keeps the part to the left of the line from a to b, in `out`.
void cut_piece(const SeenPiece& in, const Vec2& a, const Vec2& b, SeenPiece& out) {
    out.clear();
    if (in.empty()) return;
    LineSide s = line_side(a, b, in[0]);
    for (std::size_t i = 0; i < in.size(); ++i) {
        const Vec3 &p = in[i], &q = in[(i + 1) % in.size()];
        const LineSide t = line_side(a, b, q);
        if (s.sign >= 0) out.push_back(p);
        if (s.sign * t.sign < 0) {
            const double both = s.size + t.size;
            out.push_back(mix(p, q, both > 0 ? s.size / both : 0.5));
        }
        s = t;
    }
}

/// Keeps the part inside an anticlockwise triangle. spare: memory.
void cut_piece(SeenPiece& piece, const SeenTriangle& by, SeenPiece& spare) {
    for (std::size_t k = 0; k < 3 && !piece.empty(); ++k) {
        cut_piece(piece, in_plane(by[k]), in_plane(by[(k + 1) % 3]), spare);
        piece.swap(spare);
    }
}

/// The height of a triangle's plane at a point in it, between the heights of its corners.
double height_in(const SeenTriangle& t, const Vec3& p) {
    std::array<double, 3> weight;
    double sum = 0, height = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 a = in_plane(t[(k + 1) % 3]), b = in_plane(t[(k + 2) % 3]);
        weight[k] = std::max(0.0, cross(b - a, in_plane(p) - a));
        sum += weight[k];
    }
    if (!(sum > 0)) return t[0].z;
    for (std::size_t k = 0; k < 3; ++k) height += weight[k] / sum * t[k].z;
    return height;
}

struct VolumeSums {
    VolumeSide above, below;
    double compared = 0, level = 0;

    static void join(VolumeSide& a, const VolumeSide& b) {
        a.volume += b.volume;
        a.area += b.area;
        a.deepest = std::max(a.deepest, b.deepest);
    }
    static VolumeSums joined(VolumeSums a, const VolumeSums& b) {
        join(a.above, b.above);
        join(a.below, b.below);
        a.compared += b.compared;
        a.level += b.level;
        return a;
    }

    /// Adds a triangle with these heights above the reference at its corners.
    void add(double area, double a, double b, double c, int sign) {
        const double low = std::min({a, b, c}), high = std::max({a, b, c}), middle = a + b + c - low - high;
        const double all = area * ((a + b + c) / 3);
        double up = 0, up_area = 0, down = 0, down_area = 0;
        if (low >= 0) {
            up = all;
            up_area = high > 0 ? area : 0;
        } else if (high <= 0) {
            down = -all;
            down_area = area;
        } else if (middle <= 0) { // the corner of `high` is cut off
            up_area = area * (high / (high - low)) * (high / (high - middle));
            up = up_area * high / 3;
            down = std::max(0.0, up - all);
            down_area = area - up_area;
        } else {
            down_area = area * (low / (low - high)) * (low / (low - middle));
            down = -down_area * low / 3;
            up = std::max(0.0, all + down);
            up_area = area - down_area;
        }
        join(above, {sign * up, sign * up_area, std::max(0.0, high)});
        join(below, {sign * down, sign * down_area, std::max(0.0, -low)});
        compared += sign * area;
        if (low == 0 && high == 0) level += sign * area;
    }

    /// Adds a piece whose z is the height above the reference.
    void add(const SeenPiece& piece, int sign) {
        for (std::size_t i = 2; i < piece.size(); ++i) {
            const Vec3 &a = piece[0], &b = piece[i - 1], &c = piece[i];
            add(std::max(0.0, cross(in_plane(b) - in_plane(a), in_plane(c) - in_plane(a)) / 2), a.z, b.z, c.z,
                sign);
        }
    }
};

Box flat_box(std::span<const Vec3> points) {
    Box box;
    for (const Vec3& p : points) box.add(Vec3{p.x, p.y, 0});
    return box;
}

/// Triangles in the plane that are found by place. All are anticlockwise.
class SeenTriangleIndex {
  public:
    explicit SeenTriangleIndex(std::vector<SeenTriangle> triangles)
        : triangles_(std::move(triangles)), tree_(boxes(triangles_)) {}

    template <class Found>
    void visit(const Box& box, Found&& found) const {
        tree_.visit(box, [&](Index i) { found(i, triangles_[i]); });
    }

  private:
    static std::vector<Box> boxes(const std::vector<SeenTriangle>& triangles) {
        std::vector<Box> boxes(triangles.size());
        parallel_for(boxes.size(), [&](std::size_t i) { boxes[i] = flat_box(triangles[i]); });
        return boxes;
    }
    std::vector<SeenTriangle> triangles_;
    BoxTree tree_;
};

SeenTriangle upward_triangle(const SeenSurface& s, std::size_t t) {
    SeenTriangle out{s.points[s.corners[3 * t]], s.points[s.corners[3 * t + 1]],
                     s.points[s.corners[3 * t + 2]]};
    if (s.turn[t] < 0) std::swap(out[1], out[2]);
    return out;
}

/// The footprint, relative to the view's origin.
class SeenFootprint {
  public:
    SeenFootprint(const Footprint& footprint, const TerrainView& view)
        : footprint_(moved(footprint, view)), inside_(triangles(footprint_)) {}

    const Footprint& footprint() const { return footprint_; }

    /// Calls with(piece) for the pieces of a triangle inside the footprint. spare: memory.
    template <class With>
    void pieces(const SeenTriangle& triangle, SeenPiece& piece, SeenPiece& spare, With&& with) const {
        RingTree::Bounds bounds;
        for (const Vec3& p : triangle) bounds.add(in_plane(p));
        bool at_outline = false;
        footprint_.tree().query(bounds, [&](Index) {
            at_outline = true;
            return false;
        });
        piece.assign(triangle.begin(), triangle.end());
        if (!at_outline) {
            if (footprint_.locate(in_plane(triangle[0])) != polygon::PointLocation::outside) with(piece);
            return;
        }
        inside_.visit(flat_box(triangle), [&](Index, const SeenTriangle& by) {
            piece.assign(triangle.begin(), triangle.end());
            cut_piece(piece, by, spare);
            if (piece.size() > 2) with(piece);
        });
    }

  private:
    static Footprint moved(const Footprint& footprint, const TerrainView& view) {
        auto rings = footprint.rings();
        for (auto& ring : rings)
            for (Vec2& p : ring) p = p - in_plane(view.origin);
        return Footprint(std::move(rings));
    }
    static std::vector<SeenTriangle> triangles(const Footprint& footprint) {
        std::vector<Vec2> points;
        for (const auto& ring : footprint.rings()) points.insert(points.end(), ring.begin(), ring.end());
        const auto t = polygon::triangulate_rings(footprint.spans());
        for (const auto& added : t.added) points.push_back(added.at);
        std::vector<SeenTriangle> out;
        out.reserve(t.triangles.size());
        const auto at = [&](Index i) { return Vec3{points[i].x, points[i].y, 0}; };
        for (const auto& [a, b, c] : t.triangles) out.push_back({at(a), at(b), at(c)});
        return out;
    }

    Footprint footprint_;
    SeenTriangleIndex inside_;
};

/// VolumeSums over the overlay of the surface, the footprint and the other surface, if given.
class VolumeOverlay {
  public:
    VolumeOverlay(const SeenSurface& surface, const SeenFootprint* footprint)
        : s_(surface), footprint_(footprint) {}

    VolumeSums against_level(double level) const {
        return sum([&](SeenPiece& piece, SeenPiece&, std::size_t t, VolumeSums& sums) {
            for (Vec3& p : piece) p.z -= level;
            sums.add(piece, s_.sign[t]);
        });
    }

    VolumeSums against(const SeenSurface& other) const {
        std::vector<SeenTriangle> triangles;
        std::vector<std::int8_t> signs;
        triangles.reserve(other.size());
        signs.reserve(other.size());
        for (std::size_t t = 0; t < other.size(); ++t) {
            if (other.sign[t] == 0) continue;
            triangles.push_back(upward_triangle(other, t));
            signs.push_back(other.sign[t]);
        }
        const SeenTriangleIndex index(std::move(triangles));
        return sum([&](const SeenPiece& piece, SeenPiece& spare, std::size_t t, VolumeSums& sums) {
            SeenPiece part;
            index.visit(flat_box(piece), [&](Index i, const SeenTriangle& by) {
                part = piece;
                cut_piece(part, by, spare);
                for (Vec3& p : part) p.z -= height_in(by, p);
                sums.add(part, s_.sign[t] * signs[i]);
            });
        });
    }

  private:
    template <class Add>
    VolumeSums sum(Add&& add) const {
        constexpr std::size_t chunk = 512;
        return parallel_reduce(
            s_.size(), VolumeSums{},
            [&](std::size_t begin, std::size_t end) {
                VolumeSums sums;
                SeenPiece piece, spare;
                for (std::size_t t = begin; t < end; ++t) {
                    if (s_.sign[t] == 0) continue;
                    const SeenTriangle triangle = upward_triangle(s_, t);
                    piece.assign(triangle.begin(), triangle.end());
                    if (footprint_)
                        footprint_->pieces(triangle, piece, spare,
                                           [&](SeenPiece& p) { add(p, spare, t, sums); });
                    else
                        add(piece, spare, t, sums);
                }
                return sums;
            },
            VolumeSums::joined, chunk);
    }

    const SeenSurface& s_;
    const SeenFootprint* footprint_;
};

/// The area inside one outline and outside of the other. Both wind at most once around any place.
double area_outside_of(const Contours& inside, const Contours* outside) {
    Contours both = inside;
    if (outside) {
        const auto first = static_cast<Index>(both.points.size());
        both.points.insert(both.points.end(), outside->points.begin(), outside->points.end());
        for (const auto& e : outside->edges) both.edges.push_back({first + e.from, first + e.to, -e.count});
    }
    const polygon::Triangulation t = polygon::triangulate_contours(both);
    for (const auto& added : t.added) both.points.push_back(added.at);
    double area = 0;
    for (std::size_t i = 0; i < t.triangles.size(); ++i) {
        if (t.winding[i] <= 0) continue;
        const auto& [a, b, c] = t.triangles[i];
        area += std::max(0.0, cross(both.points[b] - both.points[a], both.points[c] - both.points[a]) / 2);
    }
    return area;
}

Contours contours_of_footprint(const Footprint& footprint) {
    Contours out;
    for (const auto& ring : footprint.rings()) {
        const auto first = static_cast<Index>(out.points.size()), n = static_cast<Index>(ring.size());
        out.points.insert(out.points.end(), ring.begin(), ring.end());
        for (Index i = 0; i < n; ++i) out.edges.push_back({first + i, first + (i + 1) % n, 1});
    }
    return out;
}

/// The volumes of a solid whose faces may look inward.
void set_solid_volumes(VolumeResult& r, const VolumeSums& sums) {
    r.above.volume = sums.above.volume;
    r.below.volume = 0.0 - sums.below.volume; // not -0
    if (r.above.volume + r.below.volume < 0) {
        r.above.volume = 0.0 - r.above.volume;
        r.below.volume = 0.0 - r.below.volume;
    }
    r.above.deepest = sums.above.deepest;
    r.below.deepest = sums.below.deepest;
}

Box box_of_both(const Surface& surface, const VolumeSettings& s) {
    Box box = surface.bounds();
    if (s.other) box.add(s.other->bounds());
    if (!s.footprint) return box;
    const TerrainView view{s.axis, {}};
    for (const auto& ring : s.footprint->rings())
        for (const Vec2& p : ring) box.add(view.world({p.x, p.y, box.empty() ? 0 : box.min[s.axis]}));
    return box;
}

} // namespace

VolumeResult volume_between(const Surface& surface, const VolumeSettings& settings) {
    const TerrainView view = TerrainView::of(settings.axis, box_of_both(surface, settings));
    const auto place = [&](const SeenSurface& s) {
        return s.doubled ? std::optional(view.world({s.doubled->x, s.doubled->y, -view.origin.z}))
                         : std::nullopt;
    };
    const SeenSurface seen = seen_surface(surface, view);
    std::optional<SeenSurface> other;
    if (settings.other) other = seen_surface(*settings.other, view);
    VolumeResult r;
    r.cover = seen.cover;
    r.doubled = place(seen);
    r.doubled_area = seen.doubled_area;
    if (other) {
        r.other_cover = other->cover;
        r.other_doubled = place(*other);
        r.other_doubled_area = other->doubled_area;
        if (r.other_cover == Cover::several || r.other_cover == Cover::solid || r.cover == Cover::solid)
            return r;
    }
    if (r.cover == Cover::several) return r;
    std::optional<SeenFootprint> footprint;
    if (settings.footprint) footprint.emplace(*settings.footprint, view);
    const VolumeOverlay overlay(seen, footprint ? &*footprint : nullptr);
    const VolumeSums sums =
        other ? overlay.against(*other) : overlay.against_level(settings.level - view.origin.z);
    if (r.cover == Cover::solid) {
        set_solid_volumes(r, sums);
        return r;
    }
    r.above = sums.above;
    r.below = sums.below;
    r.compared = sums.compared;
    r.level = sums.level;
    const Contours domain = footprint ? contours_of_footprint(footprint->footprint()) : seen.outline;
    r.footprint = area_outside_of(domain, nullptr);
    if (footprint) r.missing = area_outside_of(domain, &seen.outline);
    if (other) r.missing_in_other = area_outside_of(domain, &other->outline);
    return r;
}

} // namespace facetmill
