#include "geometry/deviation/pieces_beyond.hpp"

#include "base/progress.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "geometry/spatial/group_distances.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>

namespace facetmill {

namespace {

template <class T>
std::vector<T> in_a_row(std::vector<T> a, const std::vector<T>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// Neighbouring triangles, until their corners fill a group that is compared at once.
class TriangleGroup {
  public:
    TriangleGroup(const Surface& from, const FaceTree& to, std::span<const Index> near, double distance)
        : from_(from), to_(to), near_(near), distance_(distance), together_(to) {}

    void add(Index t) {
        if (is_within(t)) return;
        if (vertices_.size() + 3 > GroupDistances::most) finish();
        std::uint32_t set = 0;
        for (std::size_t k = 0; k < 3; ++k)
            set |= std::uint32_t{1} << number_of(from_.corners[3 * std::size_t{t} + k]);
        triangles_.push_back(t);
        sets_.push_back(set);
    }

    void finish() {
        if (triangles_.empty()) return;
        left_ = sets_;
        together_.remove_within(points_, distance_, left_, hint_);
        // The remaining sets keep their order.
        for (std::size_t i = 0, k = 0; k < left_.size(); ++i)
            if (sets_[i] == left_[k]) {
                beyond.push_back(triangles_[i]);
                ++k;
            }
        triangles_.clear();
        sets_.clear();
        vertices_.clear();
        points_.clear();
    }

    std::vector<Index> beyond;

  private:
    /// Whether the triangle near one corner is also near the other corners.
    bool is_within(Index t) const {
        if (near_.empty()) return false;
        const Index* const corners = &from_.corners[3 * std::size_t{t}];
        const auto near = [&](std::size_t k) { return near_[corners[k]]; };
        const auto all_near = [&](std::size_t k) {
            for (const std::size_t other : {(k + 1) % 3, (k + 2) % 3})
                if (near(other) != near(k) &&
                    !(closest_on(to_, near(k), from_.positions[corners[other]]).distance <= distance_))
                    return false;
            return true;
        };
        for (std::size_t k = 0; k < 3; ++k)
            if (near(k) != none && (k == 0 || near(k) != near(k - 1)) && all_near(k)) return true;
        return false;
    }

    std::size_t number_of(Index vertex) {
        const auto at = std::find(vertices_.begin(), vertices_.end(), vertex);
        const auto number = static_cast<std::size_t>(at - vertices_.begin());
        if (at == vertices_.end()) {
            vertices_.push_back(vertex);
            points_.push_back(from_.positions[vertex]);
        }
        return number;
    }

    const Surface& from_;
    const FaceTree& to_;
    std::span<const Index> near_;
    double distance_;
    GroupDistances together_;
    Index hint_ = none;
    std::vector<Index> triangles_, vertices_;
    std::vector<std::uint32_t> sets_, left_;
    std::vector<Vec3> points_;
};

constexpr std::size_t most_cuts = 6;  ///< maximum cuts of an edge: 28 points make 36 parts
constexpr std::size_t most_rows = 15; ///< maximum rows of a sliver: 31 points make 29 parts

double longest_edge(const SurfacePiece& piece) {
    const auto& [a, b, c] = piece.corners;
    return std::max({length(b - a), length(c - b), length(a - c)});
}

/// The number of parts of an edge, at most `most`, so that parts with even deviation are near enough to a
/// single triangle.
std::size_t cuts_of(const SurfacePiece& piece, double distance, std::size_t most) {
    const double wanted = longest_edge(piece) / (2 * distance);
    return wanted >= static_cast<double>(most)
               ? most
               : std::max<std::size_t>(2, static_cast<std::size_t>(wanted) + 1);
}

/// The corner opposite an edge that is short relative to the longest edge and to the distance, so that
/// cutting the edge would gain nothing; or none.
std::size_t tip_of(const SurfacePiece& piece, double distance) {
    const auto& p = piece.corners;
    const double a = length(p[2] - p[1]), b = length(p[0] - p[2]), c = length(p[1] - p[0]);
    const double longest = std::max({a, b, c}), shortest = std::min({a, b, c});
    if (!(3 * shortest < longest && shortest < distance)) return none;
    return shortest == a ? 0 : shortest == b ? 1 : 2;
}

/// Cuts pieces into parts, and finds the parts that are not within the distance.
class PieceCutter {
  public:
    PieceCutter(const FaceTree& to, double distance) : to_(to), distance_(distance), together_(to) {}

    /// is_part: the piece results from a cut and is known to be beyond.
    void cut(const SurfacePiece& piece, bool is_part) {
        if (!is_part && is_within(piece)) return;
        points_.clear();
        sets_.clear();
        if (const std::size_t tip = tip_of(piece, distance_); tip != none)
            lay_out_rows(piece, tip, cuts_of(piece, distance_, most_rows));
        else
            lay_out(piece, cuts_of(piece, distance_, most_cuts));
        left_ = sets_;
        together_.remove_within(points_, distance_, left_, hint_);
        for (const std::uint32_t set : left_) {
            SurfacePiece part{{}, piece.triangle};
            std::size_t corner = 0;
            for (std::size_t i = 0; i < points_.size(); ++i)
                if (set >> i & 1) part.corners[corner++] = points_[i];
            if (!is_within(part))
                beyond.push_back(part); // the part is near many triangles smaller than itself
        }
    }

    std::vector<SurfacePiece> beyond;

  private:
    /// Whether the middle is so near that the whole piece is within the distance.
    bool is_within(const SurfacePiece& piece) {
        const auto& [a, b, c] = piece.corners;
        const Vec3 middle = (a + b + c) / 3;
        const double reach = std::max({length(a - middle), length(b - middle), length(c - middle)});
        const double enough = (distance_ - reach) * (1 - 1e-9);
        if (enough < distance_ / 4) return false;
        const Closest closest = closest_point(to_, middle, hint_, enough);
        hint_ = closest.triangle;
        return closest.distance <= enough;
    }

    /// Divides each edge into n equal parts and stores the points row by row, and the parts as sets of
    /// points.
    void lay_out(const SurfacePiece& piece, std::size_t n) {
        const auto& [a, b, c] = piece.corners;
        const auto size = static_cast<double>(n);
        for (std::size_t row = 0, first = 0; row <= n; first += n + 1 - row, ++row) {
            const std::size_t above = first + n + 1 - row;
            for (std::size_t i = 0; i + row <= n; ++i) {
                points_.push_back(row == n             ? c
                                  : i == 0 && row == 0 ? a
                                  : i == n             ? b
                                                       : a + (b - a) * (static_cast<double>(i) / size) +
                                                 (c - a) * (static_cast<double>(row) / size));
                if (i + row == n) continue;
                sets_.push_back(bits(first + i, first + i + 1, above + i));
                if (i + row + 1 < n) sets_.push_back(bits(first + i + 1, above + i, above + i + 1));
            }
        }
    }

    /// Divides a sliver into n rows between its tip and the opposite edge, which is not cut.
    void lay_out_rows(const SurfacePiece& piece, std::size_t tip, std::size_t n) {
        const Vec3 &a = piece.corners[tip], &b = piece.corners[(tip + 1) % 3],
                   &c = piece.corners[(tip + 2) % 3];
        const auto size = static_cast<double>(n);
        for (std::size_t row = 0; row < n; ++row) {
            const double share = static_cast<double>(row) / size;
            points_.push_back(b + (a - b) * share);
            points_.push_back(c + (a - c) * share);
            const std::size_t i = 2 * row;
            sets_.push_back(bits(i, i + 1, i + 2));
            if (row + 1 < n) sets_.push_back(bits(i + 1, i + 2, i + 3));
        }
        points_.push_back(a);
    }

    static std::uint32_t bits(std::size_t i, std::size_t j, std::size_t k) {
        return std::uint32_t{1} << i | std::uint32_t{1} << j | std::uint32_t{1} << k;
    }

    const FaceTree& to_;
    double distance_;
    GroupDistances together_;
    Index hint_ = none;
    std::vector<Vec3> points_;
    std::vector<std::uint32_t> sets_, left_;
};

std::vector<Index> triangles_beyond(const Surface& from, std::span<const Index> order, const FaceTree& to,
                                    std::span<const Index> near, double distance) {
    ProgressScope::report_next_loop();
    return parallel_reduce(
        order.size(), std::vector<Index>{},
        [&](std::size_t begin, std::size_t end) {
            TriangleGroup group(from, to, near, distance);
            for (std::size_t i = begin; i < end; ++i) group.add(order[i]);
            group.finish();
            return std::move(group.beyond);
        },
        in_a_row<Index>, 1024);
}

/// The parts of the pieces that are beyond the distance.
std::vector<SurfacePiece> parts_beyond(std::span<const SurfacePiece> pieces, bool are_parts,
                                       const FaceTree& to, double distance) {
    return parallel_reduce(
        pieces.size(), std::vector<SurfacePiece>{},
        [&](std::size_t begin, std::size_t end) {
            PieceCutter cutter(to, distance);
            for (const SurfacePiece& piece : pieces.subspan(begin, end - begin)) cutter.cut(piece, are_parts);
            return std::move(cutter.beyond);
        },
        in_a_row<SurfacePiece>, 256);
}

constexpr int most_times = 3;        ///< the maximum number of times that a triangle is cut
constexpr std::size_t batch = 16384; ///< pieces to cut before checking whether too many remain

/// Cuts pieces up to `times` times and appends the remaining parts, including uncut pieces. Once more than
/// about `most` remain, no more are cut. The rest of a batch is cut again before the next batch.
void cut_until(std::size_t most, int times, std::span<const SurfacePiece> pieces, const FaceTree& to,
               double distance, std::vector<SurfacePiece>& left) {
    while (times > 0 && !pieces.empty() && left.size() <= most) {
        const auto some = pieces.first(std::min(batch, pieces.size()));
        cut_until(most, times - 1, parts_beyond(some, times < most_times, to, distance), to, distance, left);
        pieces = pieces.subspan(some.size());
    }
    left.insert(left.end(), pieces.begin(), pieces.end());
}

} // namespace

Beyond pieces_beyond(const Surface& from, std::span<const Index> order, const FaceTree& to,
                     std::span<const Index> near, double distance, std::size_t most) {
    ProgressSteps steps({1, 5});
    Beyond beyond;
    std::vector<Index>& triangles = beyond.triangles;
    triangles = triangles_beyond(from, order, to, near, distance);
    steps.next();
    std::size_t done = 0;
    while (done < triangles.size() && beyond.pieces.size() <= most) {
        std::vector<SurfacePiece> whole;
        for (const std::size_t end = std::min(done + batch, triangles.size()); done < end; ++done) {
            const Index t = triangles[done];
            whole.push_back({{from.point(t, 0), from.point(t, 1), from.point(t, 2)}, t});
        }
        cut_until(most, most_times, whole, to, distance, beyond.pieces);
        ProgressScope::report(static_cast<double>(done) / static_cast<double>(triangles.size()));
    }
    triangles.erase(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(done));
    return beyond;
}

} // namespace facetmill
