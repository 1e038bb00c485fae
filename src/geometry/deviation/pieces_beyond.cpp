#include "geometry/deviation/pieces_beyond.hpp"

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "geometry/spatial/group_distances.hpp"

#include <algorithm>

namespace facetmill {

namespace {

template <class T>
std::vector<T> in_a_row(std::vector<T> a, const std::vector<T>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// Triangles beside each other, until their corners are as many as are compared at once.
class TriangleGroup {
  public:
    TriangleGroup(const Surface& from, const FaceTree& to, double distance)
        : from_(from), distance_(distance), together_(to) {}

    void add(Index t) {
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
        // What is left is in the order in which it was.
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
    double distance_;
    GroupDistances together_;
    Index hint_ = none;
    std::vector<Index> triangles_, vertices_;
    std::vector<std::uint32_t> sets_, left_;
    std::vector<Vec3> points_;
};

constexpr std::size_t most_cuts = 6; ///< of an edge: 28 points make 36 parts

double longest_edge(const SurfacePiece& piece) {
    const auto& [a, b, c] = piece.corners;
    return std::max({length(b - a), length(c - b), length(a - c)});
}

/// Into how many an edge is cut, so that parts of even deviation are near enough to one triangle.
std::size_t cuts_of(const SurfacePiece& piece, double distance) {
    const double wanted = longest_edge(piece) / (1.5 * distance);
    return wanted >= most_cuts ? most_cuts : std::max<std::size_t>(2, static_cast<std::size_t>(wanted) + 1);
}

/// Cuts pieces into parts and finds those that are not within the distance.
class PieceCutter {
  public:
    PieceCutter(const FaceTree& to, double distance) : to_(to), distance_(distance), together_(to) {}

    void cut(const SurfacePiece& piece) {
        if (is_within(piece)) return;
        lay_out(piece, cuts_of(piece, distance_));
        left_ = sets_;
        together_.remove_within(points_, distance_, left_, hint_);
        for (const std::uint32_t set : left_) {
            SurfacePiece part{{}, piece.triangle};
            std::size_t corner = 0;
            for (std::size_t i = 0; i < points_.size(); ++i)
                if (set >> i & 1) part.corners[corner++] = points_[i];
            beyond.push_back(part);
        }
    }

    std::vector<SurfacePiece> beyond;

  private:
    /// Whether its middle is so near that all of it is.
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

    /// The points of n equal parts of each edge and between them, row by row, and the parts as sets of them.
    void lay_out(const SurfacePiece& piece, std::size_t n) {
        const auto& [a, b, c] = piece.corners;
        points_.clear();
        sets_.clear();
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
                                    double distance) {
    Share::loop_tells();
    return parallel_reduce(
        order.size(), std::vector<Index>{},
        [&](std::size_t begin, std::size_t end) {
            TriangleGroup group(from, to, distance);
            for (std::size_t i = begin; i < end; ++i) group.add(order[i]);
            group.finish();
            return std::move(group.beyond);
        },
        in_a_row<Index>, 1024);
}

/// The parts of items `begin` to `end` that are beyond; piece_of(i) is the i-th.
template <class PieceOf>
std::vector<SurfacePiece> parts_beyond(std::size_t begin, std::size_t end, const FaceTree& to,
                                       double distance, const PieceOf& piece_of) {
    return parallel_reduce(
        end - begin, std::vector<SurfacePiece>{},
        [&](std::size_t first, std::size_t last) {
            PieceCutter cutter(to, distance);
            for (std::size_t i = begin + first; i < begin + last; ++i) cutter.cut(piece_of(i));
            return std::move(cutter.beyond);
        },
        in_a_row<SurfacePiece>, 256);
}

/// Cuts the items one after the other, until all are or the parts are more than `most`. Returns how many are.
template <class PieceOf>
std::size_t cut_until(std::size_t most, std::size_t count, const FaceTree& to, double distance,
                      const PieceOf& piece_of, std::vector<SurfacePiece>& parts) {
    constexpr std::size_t batch = 16384;
    std::size_t done = 0;
    while (done < count && parts.size() <= most) {
        const std::size_t end = std::min(done + batch, count);
        parts = in_a_row(std::move(parts), parts_beyond(done, end, to, distance, piece_of));
        done = end;
        Share::tell(static_cast<double>(done) / static_cast<double>(count));
    }
    return done;
}

} // namespace

Beyond pieces_beyond(const Surface& from, std::span<const Index> order, const FaceTree& to, double distance,
                     std::size_t most) {
    ShareOfSteps steps({1, 4, 1});
    Beyond beyond;
    std::vector<Index>& triangles = beyond.triangles;
    std::vector<SurfacePiece>& pieces = beyond.pieces;
    triangles = triangles_beyond(from, order, to, distance);
    steps.next();
    const auto whole = [&](std::size_t i) {
        const Index t = triangles[i];
        return SurfacePiece{{from.point(t, 0), from.point(t, 1), from.point(t, 2)}, t};
    };
    const std::size_t cut = cut_until(most, triangles.size(), to, distance, whole, pieces);
    triangles.erase(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(cut));
    steps.next();
    for (int again = 0; again < 2 && pieces.size() <= most; ++again) {
        std::vector<SurfacePiece> parts;
        const auto piece = [&](std::size_t i) { return pieces[i]; };
        const std::size_t done = cut_until(most, pieces.size(), to, distance, piece, parts);
        parts.insert(parts.end(), pieces.begin() + static_cast<std::ptrdiff_t>(done), pieces.end());
        pieces = std::move(parts);
    }
    return beyond;
}

} // namespace facetmill
