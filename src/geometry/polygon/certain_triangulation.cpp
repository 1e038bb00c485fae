// Triangles are wrapped from edge to edge, as in the constrained Delaunay triangulation (D. T. Lee and A. K.
// Lin, "Generalized Delaunay triangulation for planar graphs", 1986). A proof that they are a triangulation
// follows.
#include "geometry/polygon/certain_triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace facetmill::polygon {

namespace {

constexpr std::size_t most_points = 48;
constexpr double unit = 0x1p-52;

/// A determinant of points, with the magnitude of its terms.
struct Sized {
    double det, size;
};
double size_of(std::initializer_list<double> differences) {
    double size = 0;
    for (const double d : differences) size = std::max(size, std::abs(d));
    return size;
}
Sized turn_of(const Vec2& a, const Vec2& b, const Vec2& c) {
    const Vec2 u = b - a, v = c - a;
    return {u.x * v.y - u.y * v.x, size_of({u.x, u.y, v.x, v.y})};
}
/// The sign of a determinant above this bound is certain.
double bound_of(double size, double off) { return 16 * size * (2 * off + unit * size); }

/// The largest error of any coordinate. None if a product could overflow, or underflow where it matters.
std::optional<double> error_of(const CutTriangle& cut) {
    double most = 0;
    for (const Vec2& p : cut.points) most = std::max({most, std::abs(p.x), std::abs(p.y)});
    return most > 1e-60 && most < 1e60 ? std::optional(most * unit) : std::nullopt;
}

class CertainTriangulation {
  public:
    explicit CertainTriangulation(const CutTriangle& cut) : cut_(cut), count_(cut.points.size()) {}

    std::optional<std::vector<std::array<Index, 3>>> run() {
        const auto off = error_of(cut_);
        if (count_ > most_points || !off || !mark_sides()) return {};
        off_ = *off;
        for (const auto& [a, b] : cut_.lines)
            if (!(cut_.sides[a] & cut_.sides[b])) lines_.push_back({a, b});
        for (const auto& [a, b] : lines_) fixed_[a][b] = fixed_[b][a] = 1;
        if (!wrap() || !is_proved()) return {};
        return std::move(triangles_);
    }

  private:
    const Vec2& at(Index i) const { return cut_.points[i]; }

    bool mark_sides() {
        auto border = certain_border(cut_);
        if (!border) return false;
        border_edges_ = std::move(*border);
        for (const auto& [a, b] : border_edges_) border_[a][b] = 1;
        return true;
    }

    Sized turn(Index a, Index b, Index c) const { return turn_of(at(a), at(b), at(c)); }
    /// Positive if d is in the circle of a, b and c, which turn left.
    Sized circle(Index a, Index b, Index c, Index d) const {
        const Vec2 u = at(a) - at(d), v = at(b) - at(d), w = at(c) - at(d);
        return {dot(u, u) * cross(v, w) + dot(v, v) * cross(w, u) + dot(w, w) * cross(u, v),
                size_of({u.x, u.y, v.x, v.y, w.x, w.y})};
    }
    bool turns_left(Index a, Index b, Index c) const { return surely_left(at(a), at(b), at(c), off_); }
    // --- finding triangles: these steps need not be certain

    bool is_crossed(Index p, Index q) const {
        return std::any_of(lines_.begin(), lines_.end(), [&](const auto& line) {
            const auto& [u, v] = line;
            if (u == p || u == q || v == p || v == q) return false;
            return turn(p, q, u).det * turn(p, q, v).det < 0 && turn(u, v, p).det * turn(u, v, q).det < 0;
        });
    }
    Index apex_of(Index a, Index b) const {
        Index best = none;
        for (Index c = 0; c < count_; ++c) {
            if (c == a || c == b || (cut_.sides[a] & cut_.sides[b] & cut_.sides[c])) continue;
            if (!(turn(a, b, c).det > 0) || (best != none && !(circle(a, b, best, c).det > 0))) continue;
            if (!is_crossed(a, c) && !is_crossed(b, c)) best = c;
        }
        return best;
    }
    bool wrap() {
        for (auto& row : across_) row.fill(none);
        std::vector<std::array<Index, 2>> open = border_edges_;
        while (!open.empty()) {
            const auto [a, b] = open.back();
            open.pop_back();
            if (across_[a][b] != none) continue;
            const Index c = apex_of(a, b);
            if (c == none || across_[b][c] != none || across_[c][a] != none) return false;
            across_[a][b] = c;
            across_[b][c] = a;
            across_[c][a] = b;
            triangles_.push_back({a, b, c});
            for (const auto& [from, to] : {std::array{c, b}, std::array{a, c}}) {
                if (border_[to][from]) continue;
                open.push_back({from, to});
                if (!fixed_[from][to]) lines_.push_back({from, to}); // points on a circle need one diagonal
                fixed_[from][to] = fixed_[to][from] = 1;
            }
        }
        return true;
    }

    // --- proving them

    bool is_proved() const {
        if (triangles_.size() + border_edges_.size() + 2 != 2 * count_) return false; // all points are used
        for (const auto& [a, b] : lines_) // all other edges must pair up
            if (across_[a][b] == none || across_[b][a] == none) return false;
        for (const auto& [a, b, c] : triangles_)
            if (!turns_left(a, b, c)) return false;
        for (Index a = 0; a < count_; ++a)
            for (Index b = 0; b < count_; ++b) {
                if (across_[a][b] == none || border_[a][b]) continue;
                if (across_[b][a] == none || border_[b][a]) return false;
            }
        return true;
    }

    template <class T>
    using Matrix = std::array<std::array<T, most_points>, most_points>;

    const CutTriangle& cut_;
    std::size_t count_;
    double off_ = 0; ///< the largest error of any coordinate
    std::vector<std::array<Index, 2>> lines_, border_edges_;
    Matrix<std::uint8_t> fixed_{},
        border_{}; ///< by ends: 1 for a line; 1 for an edge along a side, with the inside on its left
    Matrix<Index> across_{}; ///< the third corner of the triangle left of an edge
    std::vector<std::array<Index, 3>> triangles_;
};

/// Finds crossing lines: lines whose boxes meet are tested, from left to right.
class CertainCrossings {
  public:
    CertainCrossings(const CutTriangle& cut, double off) : cut_(cut), off_(off) {
        for (Index i = 0; i < cut.lines.size(); ++i) {
            const auto& [a, b] = cut.lines[i];
            const auto [left, right] = std::minmax({at(a).x, at(b).x});
            const auto [below, above] = std::minmax({at(a).y, at(b).y});
            spans_.push_back({left - off, right + off, below - off, above + off, i});
        }
        std::sort(spans_.begin(), spans_.end(), [](const Span& s, const Span& t) {
            return std::pair(s.left, s.line) < std::pair(t.left, t.line);
        });
    }

    std::optional<std::vector<std::array<Index, 2>>> run() const {
        std::vector<std::array<Index, 2>> found;
        for (auto s = spans_.begin(); s != spans_.end(); ++s)
            for (auto t = s + 1; t != spans_.end() && t->left <= s->right; ++t) {
                if (t->below > s->above || s->below > t->above) continue;
                const auto cross = do_cross(cut_.lines[s->line], cut_.lines[t->line]);
                if (!cross) return {};
                if (*cross) found.push_back({std::min(s->line, t->line), std::max(s->line, t->line)});
            }
        std::sort(found.begin(), found.end());
        return found;
    }

  private:
    struct Span {
        double left, right, below, above;
        Index line;
    };
    const Vec2& at(Index i) const { return cut_.points[i]; }

    /// 1: left, -1: right, 0: uncertain.
    int sure_turn(Index a, Index b, Index c) const {
        const auto [det, size] = turn_of(at(a), at(b), at(c));
        const double bound = bound_of(size, off_);
        return det > bound ? 1 : det < -bound ? -1 : 0;
    }
    std::optional<bool> do_cross(const std::array<Index, 2>& one, const std::array<Index, 2>& other) const {
        const auto& [a, b] = one;
        const auto& [c, d] = other;
        if (a == c || a == d || b == c || b == d) return false;
        if ((cut_.sides[a] & cut_.sides[b]) != 0 || (cut_.sides[c] & cut_.sides[d]) != 0) return false;
        const int across_one = sure_turn(a, b, c) * sure_turn(a, b, d);
        if (across_one > 0) return false;
        const int across_other = sure_turn(c, d, a) * sure_turn(c, d, b);
        if (across_other > 0) return false;
        return across_one < 0 && across_other < 0 ? std::optional(true) : std::nullopt;
    }

    const CutTriangle& cut_;
    double off_;
    std::vector<Span> spans_;
};

} // namespace

std::optional<std::vector<std::array<Index, 2>>> certain_border(const CutTriangle& cut) {
    const auto at = [&](Index i) { return cut.points[i]; };
    const auto off = error_of(cut);
    if (!off) return {};
    std::vector<std::array<Index, 2>> border;
    for (Index k = 0; k < 3; ++k) {
        const Index from = k, to = (k + 1) % 3;
        const Vec2 way = at(to) - at(from);
        const bool by_x = std::abs(way.x) >= std::abs(way.y);
        const double sign = (by_x ? way.x : way.y) > 0 ? 1 : -1;
        const auto place = [&](Index i) { return sign * (by_x ? at(i).x : at(i).y); };
        std::vector<Index> along;
        for (Index i = 0; i < cut.points.size(); ++i)
            if (cut.sides[i] >> k & 1) along.push_back(i);
        std::sort(along.begin(), along.end(), [&](Index i, Index j) { return place(i) < place(j); });
        if (along.size() < 2 || along.front() != from || along.back() != to) return {};
        for (std::size_t i = 0; i + 1 < along.size(); ++i) {
            if (!(place(along[i + 1]) - place(along[i]) > 8 * *off)) return {};
            border.push_back({along[i], along[i + 1]});
        }
    }
    return border;
}

bool surely_left(const Vec2& a, const Vec2& b, const Vec2& c, double off) {
    const auto [det, size] = turn_of(a, b, c);
    return det > bound_of(size, off);
}

std::optional<std::vector<std::array<Index, 3>>> certain_triangulation(const CutTriangle& cut) {
    return CertainTriangulation(cut).run();
}

std::optional<std::vector<std::array<Index, 2>>> certain_crossings(const CutTriangle& cut) {
    const auto off = error_of(cut);
    return off ? CertainCrossings(cut, *off).run() : std::nullopt;
}

} // namespace facetmill::polygon
