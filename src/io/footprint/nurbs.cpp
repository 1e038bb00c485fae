#include "io/footprint/nurbs.hpp"

#include <algorithm>

namespace facetmill::io {

namespace {

/// A point times its weight, and the weight.
struct Weighted {
    double x = 0, y = 0, w = 1;
};

class Flattener {
  public:
    Flattener(const Nurbs& curve, std::size_t most) : curve_(curve), most_(most) {}

    std::vector<Vec2> run() {
        const auto degree = static_cast<std::size_t>(curve_.degree);
        constexpr int first_pieces = 8; // so that no inflection hides between
        for (span_ = degree; span_ < curve_.points.size(); ++span_) {
            const double from = curve_.knots[span_], to = curve_.knots[span_ + 1];
            if (!(from < to)) continue;
            if (out_.empty()) out_.push_back(at(from));
            double t0 = from;
            for (int i = 1; i <= first_pieces && out_.size() < most_; ++i) {
                const double t1 = i == first_pieces ? to : from + (to - from) * i / first_pieces;
                divide(t0, out_.back(), t1, at(t1), 0);
                t0 = t1;
            }
        }
        return std::move(out_);
    }

  private:
    /// Appends the points after t0 up to t1.
    void divide(double t0, const Vec2& p0, double t1, const Vec2& p1, int depth) {
        constexpr int deepest = 7;
        constexpr double cosine_of_step = 0.99619469809174555; // of 5 degrees
        const double middle = t0 + (t1 - t0) / 2;
        const Vec2 m = at(middle), a = m - p0, b = p1 - m;
        const bool straight = dot(a, b) >= cosine_of_step * (length(a) * length(b));
        if (straight || depth == deepest || out_.size() >= most_) {
            out_.push_back(m);
            out_.push_back(p1);
            return;
        }
        divide(t0, p0, middle, m, depth + 1);
        divide(middle, m, t1, p1, depth + 1);
    }

    Vec2 at(double t) const {
        const auto degree = static_cast<std::size_t>(curve_.degree);
        Weighted d[Nurbs::highest_degree + 1];
        for (std::size_t i = 0; i <= degree; ++i) {
            const std::size_t p = span_ - degree + i;
            const double w = curve_.weights.empty() ? 1 : curve_.weights[p];
            d[i] = {curve_.points[p].x * w, curve_.points[p].y * w, w};
        }
        for (std::size_t r = 1; r <= degree; ++r)
            for (std::size_t i = degree; i >= r; --i) {
                const double low = curve_.knots[span_ - degree + i], high = curve_.knots[span_ + 1 + i - r];
                const double s = (t - low) / (high - low);
                d[i] = {d[i - 1].x + (d[i].x - d[i - 1].x) * s, d[i - 1].y + (d[i].y - d[i - 1].y) * s,
                        d[i - 1].w + (d[i].w - d[i - 1].w) * s};
            }
        return {d[degree].x / d[degree].w, d[degree].y / d[degree].w};
    }

    const Nurbs& curve_;
    std::size_t most_;
    std::size_t span_ = 0; ///< knots[span_] <= t <= knots[span_ + 1]
    std::vector<Vec2> out_;
};

} // namespace

bool Nurbs::is_valid() const {
    const auto n = static_cast<std::size_t>(degree);
    return degree >= 1 && degree <= highest_degree && points.size() > n &&
           knots.size() == points.size() + n + 1 && (weights.empty() || weights.size() == points.size()) &&
           std::is_sorted(knots.begin(), knots.end()) && knots[n] < knots[points.size()] &&
           std::all_of(weights.begin(), weights.end(), [](double w) { return w > 0; });
}

std::vector<Vec2> flattened(const Nurbs& curve, std::size_t most_points) {
    return Flattener(curve, most_points).run();
}

} // namespace facetmill::io
