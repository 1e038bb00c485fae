#include "geometry/unwrap/untangle.hpp"

#include "base/sort_unique.hpp"

namespace facetmill::unwrap_room {

namespace {

constexpr double poor = 0.05;       // quality below which a triangle is improved; 1 is its own shape
constexpr std::size_t most_bad = 8; // one of so many triangles may be bad
constexpr int sweeps = 12;

class Untangler {
  public:
    Untangler(const std::vector<Index>& corners, const std::vector<FlatShape>& shapes,
              std::vector<Vec2>& points)
        : corners_(corners), shapes_(shapes), points_(points) {}

    void run() {
        for (int sweep = 0; sweep < sweeps; ++sweep) {
            const std::vector<Index> bad = bad_points();
            if (bad.empty()) return;
            if (around_.offsets.empty()) around_ = triangles_around(corners_, points_.size());
            for (const Index p : bad) improve(p);
        }
    }

  private:
    /// 1 for the shape of the triangle itself; the area, as a share, if it is flipped.
    double quality(std::size_t f) const {
        const Vec2 &p = points_[corners_[3 * f]], &q = points_[corners_[3 * f + 1]],
                   &r = points_[corners_[3 * f + 2]];
        const FlatShape& s = shapes_[f];
        // The map J from the triangle's plane to the texture.
        const Vec2 a = q - p, b = r - p, ju = a * (1 / s.length), jv = (b - ju * s.x) * (1 / s.height);
        const double det = cross(ju, jv);
        if (!(det > 0)) return det;
        return 2 * det / (dot(ju, ju) + dot(jv, jv)) * std::min(det, 1 / det);
    }

    /// The corners of bad triangles; none if too many are bad.
    std::vector<Index> bad_points() const {
        std::vector<Index> list;
        const std::size_t faces = shapes_.size();
        for (std::size_t f = 0; f < faces; ++f)
            if (quality(f) < poor)
                list.insert(list.end(), {corners_[3 * f], corners_[3 * f + 1], corners_[3 * f + 2]});
        if (list.size() / 3 > faces / most_bad + 1) return {};
        sort_unique(list);
        return list;
    }

    double worst_around(Index p) const {
        double worst = HUGE_VAL;
        for (const Index f : around_.of(p)) worst = std::min(worst, quality(f));
        return worst;
    }

    void improve(Index p) {
        double step = 0;
        for (const Index f : around_.of(p)) step = std::max(step, shapes_[f].length);
        double best = worst_around(p);
        constexpr Vec2 directions[] = {{1, 0},     {0, 1},      {-1, 0},      {0, -1},
                                       {0.7, 0.7}, {-0.7, 0.7}, {-0.7, -0.7}, {0.7, -0.7}};
        for (int halving = 0; halving < 10; ++halving, step /= 2)
            for (const Vec2& d : directions) {
                const Vec2 before = points_[p];
                points_[p] = before + d * step;
                if (const double q = worst_around(p); q > best)
                    best = q;
                else
                    points_[p] = before;
            }
    }

    const std::vector<Index>& corners_;
    const std::vector<FlatShape>& shapes_;
    std::vector<Vec2>& points_;
    VertexLists around_; ///< triangles around each point
};

} // namespace

VertexLists triangles_around(const std::vector<Index>& corners, std::size_t points) {
    VertexLists lists;
    lists.offsets.assign(points + 1, 0);
    for (const Index p : corners) ++lists.offsets[p + 1];
    for (std::size_t i = 1; i < lists.offsets.size(); ++i) lists.offsets[i] += lists.offsets[i - 1];
    lists.items.resize(corners.size());
    std::vector<Index> next(lists.offsets.begin(), lists.offsets.end() - 1);
    for (std::size_t c = 0; c < corners.size(); ++c)
        lists.items[next[corners[c]]++] = static_cast<Index>(c / 3);
    return lists;
}

void untangle_triangles(const std::vector<Index>& corners, const std::vector<FlatShape>& shapes,
                        std::vector<Vec2>& points) {
    if (shapes.size() > 1) Untangler(corners, shapes, points).run();
}

} // namespace facetmill::unwrap_room
