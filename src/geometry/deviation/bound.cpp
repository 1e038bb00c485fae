#include "geometry/deviation/bound.hpp"

#include "base/progress.hpp"
#include "geometry/deviation/pieces_beyond.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace facetmill {

namespace {

/// A corner, its distance from the other surface, and the closest triangle of that surface.
struct Corner {
    Vec3 at;
    Closest closest;
};

/// A triangle of the surface, or a part of it, and an upper bound of the distance of its points.
struct Piece {
    std::array<Corner, 3> corners;
    double bound = HUGE_VAL;
    Index face = none;
};

/// The largest distance of the corners to a single triangle, which bounds the whole piece.
double distance_to(const FaceTree& tree, Index triangle, const Piece& piece) {
    double most = 0;
    for (const auto& c : piece.corners)
        most = std::max(most, c.closest.triangle == triangle ? c.closest.distance
                                                             : closest_on(tree, triangle, c.at).distance);
    return most;
}

/// The bound of the piece, from its corners alone. Stops improving the bound once it reaches `enough`.
double bound_of(const FaceTree& tree, const Piece& piece, double enough) {
    const auto& [a, b, c] = piece.corners;
    const double longest = std::max({length(b.at - a.at), length(c.at - b.at), length(a.at - c.at)});
    const double most = std::max({a.closest.distance, b.closest.distance, c.closest.distance});
    constexpr double reach = 0.5773502691896258; // 1/sqrt(3): the largest distance from the nearest corner,
                                                 // relative to the longest edge
    double bound = most + longest * reach;
    for (std::size_t i = 0; i < 3 && bound > enough; ++i)
        bound = std::min(bound, distance_to(tree, piece.corners[i].closest.triangle, piece));
    return bound;
}

struct FarthestCorner {
    Vec3 from, to;
    double distance = -1;
    Index face = none;
    void consider(const Corner& c, Index f) {
        const double apart = told_from_zero(c.closest.distance, c.at);
        if (apart > distance) *this = {c.at, c.closest.point, apart, f};
    }
};

/// The result of a round for a piece.
struct Outcome {
    std::array<Piece, 4> left; ///< parts that may still hold a farther point
    std::size_t left_count = 0;
    double settled = 0; ///< the bound of the rest
    FarthestCorner farthest;
    std::size_t looked_up = 0;
};

class Certifier {
  public:
    Certifier(DirectedDeviation& d, const Surface& from, const FaceTree& to, double within,
              const DeviationSettings& settings)
        : d_(d), from_(from), tree_(to), settings_(settings), within_(within),
          slack_(from.bounds().diagonal() * 1e-6) {}

    void run(std::span<const Index> order, std::span<const Index> near) {
        ProgressRounds rounds;
        const Beyond beyond = beyond_within(order, near);
        rounds.next();
        start_with(beyond.triangles);
        start_with(beyond.pieces);
        rounds.next();
        std::size_t work = settings_.certify_work;
        while (!pieces_.empty() && work >= per_piece) {
            std::vector<Piece> later = keep_worst(work / per_piece);
            work -= round(later);
            pieces_ = std::move(later);
            rounds.next();
        }
        for (const auto& piece : pieces_) settled_ = std::max(settled_, piece.bound);
        d_.bound = std::max({settled_, within_, d_.maximum});
    }

  private:
    static constexpr std::size_t per_piece =
        4; ///< points looked up for a piece: its middle, and the middles of its edges

    double target() const { return std::max(within_, d_.maximum) * (1 + settings_.certify_to) + slack_; }

    Corner corner_at(const Vec3& p, Index hint) const { return {p, closest_point(tree_, p, hint)}; }

    /// The parts of the surface that may be farther than `within`. If `within` is nearly 0, the whole
    /// surface, because the search has only float32 precision.
    Beyond beyond_within(std::span<const Index> order, std::span<const Index> near) const {
        std::vector<Index> finite;
        for (const Index t : order)
            if (is_finite(from_.point(t, 0)) && is_finite(from_.point(t, 1)) && is_finite(from_.point(t, 2)))
                finite.push_back(t);
        if (settings_.certify_work == 0 || !(within_ > slack_)) return {std::move(finite), {}};
        return pieces_beyond(from_, finite, tree_, near, within_, settings_.certify_work / per_piece);
    }

    /// Keeps the pieces that their corners do not settle.
    template <class PieceOf>
    void keep_beyond_target(std::size_t count, const PieceOf& piece_of) {
        const double target = this->target();
        std::vector<double> bounds(count);
        parallel_for(
            count, [&](std::size_t i) { bounds[i] = bound_of(tree_, piece_of(i), target); }, 1024);
        for (std::size_t i = 0; i < count; ++i) {
            if (bounds[i] <= target) {
                settled_ = std::max(settled_, bounds[i]);
                continue;
            }
            pieces_.push_back(piece_of(i));
            pieces_.back().bound = bounds[i];
        }
    }

    void start_with(const std::vector<Index>& triangles) {
        if (triangles.empty()) return;
        std::vector<Index> number(from_.positions.size(), none);
        std::vector<Vec3> points;
        for (const Index t : triangles)
            for (std::size_t k = 0; k < 3; ++k)
                if (Index& n = number[from_.corners[3 * std::size_t{t} + k]]; n == none) {
                    n = static_cast<Index>(points.size());
                    points.push_back(from_.point(t, k));
                }
        const std::vector<Closest> closest = closest_points(tree_, points);
        keep_beyond_target(triangles.size(), [&](std::size_t i) {
            const std::size_t t = triangles[i];
            Piece piece;
            piece.face = from_.face(t);
            for (std::size_t k = 0; k < 3; ++k)
                piece.corners[k] = {from_.point(t, k), closest[number[from_.corners[3 * t + k]]]};
            return piece;
        });
    }

    void start_with(const std::vector<SurfacePiece>& pieces) {
        std::vector<Piece> with_corners(pieces.size());
        parallel_chunks(
            pieces.size(),
            [&](std::size_t begin, std::size_t end) {
                Index hint = none;
                for (std::size_t i = begin; i < end; ++i) {
                    with_corners[i].face = from_.face(pieces[i].triangle);
                    for (std::size_t k = 0; k < 3; ++k) {
                        with_corners[i].corners[k] = corner_at(pieces[i].corners[k], hint);
                        hint = with_corners[i].corners[k].closest.triangle;
                    }
                }
            },
            1024);
        for (const Piece& piece : with_corners)
            for (const Corner& corner : piece.corners) {
                FarthestCorner farthest;
                farthest.consider(corner, piece.face);
                raise(farthest);
            }
        d_.looked_up += 3 * pieces.size();
        keep_beyond_target(pieces.size(), [&](std::size_t i) { return with_corners[i]; });
    }

    void raise(const FarthestCorner& farthest) {
        if (!(farthest.distance > d_.maximum)) return;
        d_.maximum = farthest.distance;
        d_.from = farthest.from;
        d_.to = farthest.to;
        d_.face = farthest.face;
    }

    /// Leaves the `most` pieces with the largest bounds and returns the others.
    std::vector<Piece> keep_worst(std::size_t most) {
        if (pieces_.size() <= most) return {};
        std::vector<std::size_t> order(pieces_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return pieces_[a].bound != pieces_[b].bound ? pieces_[a].bound > pieces_[b].bound : a < b;
        });
        std::vector<Piece> worst, others;
        for (std::size_t i = 0; i < order.size(); ++i)
            (i < most ? worst : others).push_back(pieces_[order[i]]);
        pieces_ = std::move(worst);
        return others;
    }

    /// Settles or cuts every piece and appends the remaining parts to `later`. Returns the number of points
    /// looked up.
    std::size_t round(std::vector<Piece>& later) {
        const double target = this->target();
        std::size_t looked_up = 0;
        constexpr std::size_t batch = 16384; // limits memory, because outcomes are large
        for (std::size_t begin = 0; begin < pieces_.size(); begin += batch) {
            std::vector<Outcome> outcomes(std::min(batch, pieces_.size() - begin));
            parallel_for(
                outcomes.size(), [&](std::size_t i) { outcomes[i] = refined(pieces_[begin + i], target); },
                64);
            for (const auto& o : outcomes) {
                later.insert(later.end(), o.left.begin(), o.left.begin() + static_cast<int>(o.left_count));
                settled_ = std::max(settled_, o.settled);
                looked_up += o.looked_up;
                raise(o.farthest);
            }
        }
        d_.looked_up += looked_up;
        return looked_up;
    }

    Outcome refined(const Piece& piece, double target) const {
        Outcome o;
        const auto& [a, b, c] = piece.corners;
        const Corner middle = corner_at((a.at + b.at + c.at) / 3, a.closest.triangle);
        o.farthest.consider(middle, piece.face);
        o.looked_up = 1;
        const double bound = std::min(piece.bound, distance_to(tree_, middle.closest.triangle, piece));
        if (bound <= target) {
            o.settled = bound;
            return o;
        }
        const Corner ab = corner_at((a.at + b.at) * 0.5, a.closest.triangle);
        const Corner bc = corner_at((b.at + c.at) * 0.5, b.closest.triangle);
        const Corner ca = corner_at((c.at + a.at) * 0.5, c.closest.triangle);
        o.looked_up = per_piece;
        for (const auto& corner : {ab, bc, ca}) o.farthest.consider(corner, piece.face);
        const std::array<std::array<Corner, 3>, 4> parts{
            {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}};
        for (const auto& corners : parts) {
            Piece part{corners, bound, piece.face};
            part.bound = std::min(bound, bound_of(tree_, part, target));
            if (part.bound > target)
                o.left[o.left_count++] = part;
            else
                o.settled = std::max(o.settled, part.bound);
        }
        return o;
    }

    DirectedDeviation& d_;
    const Surface& from_;
    const FaceTree& tree_;
    const DeviationSettings& settings_;
    double within_;
    double slack_; ///< lets the search end on equal surfaces
    std::vector<Piece> pieces_;
    double settled_ = 0;
};

} // namespace

void bound_deviation(DirectedDeviation& d, const Surface& from, std::span<const Index> order,
                     const FaceTree& to, std::span<const Index> near, double within,
                     const DeviationSettings& settings) {
    if (d.vertices == 0 || to.empty())
        d.bound = d.maximum;
    else
        Certifier(d, from, to, within, settings).run(order, near);
}

} // namespace facetmill
