#include "geometry/nest/nest.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>

namespace facetmill {

namespace {

/// The upper border of the rectangles on a plate, as steps from left to right.
class Skyline {
  public:
    Skyline(double width, double depth) : width_(width), depth_(depth), steps_{{0, 0}} {}

    struct Fit {
        double x = 0, y = 0, top = HUGE_VAL;
        bool turned = false;
    };
    /// The place for a rectangle whose top is lowest, then leftmost.
    std::optional<Fit> find(double width, double depth) const {
        Fit best;
        for (std::size_t i = 0; i < steps_.size(); ++i) {
            const double x = steps_[i].x;
            if (x + width > width_ * rounding) break;
            double y = 0;
            for (std::size_t k = i; k < steps_.size() && (k == i || steps_[k].x < x + width); ++k)
                y = std::max(y, steps_[k].y);
            const double top = y + depth;
            if (top <= depth_ * rounding && top < best.top) best = {x, y, top, false};
        }
        if (best.top == HUGE_VAL) return {};
        return best;
    }
    void add(double x, double width, double top) {
        const double end = x + width;
        std::vector<Step> next;
        next.reserve(steps_.size() + 2);
        double after = 0; // the height right of the rectangle
        for (const Step& s : steps_) {
            if (s.x <= end) after = s.y;
            if (s.x < x) next.push_back(s);
        }
        next.push_back({x, top});
        if (end < width_) next.push_back({end, after});
        for (const Step& s : steps_)
            if (s.x > end) next.push_back(s);
        steps_ = std::move(next);
    }

  private:
    static constexpr double rounding = 1 + 1e-9;
    struct Step {
        double x, y;
    };
    double width_, depth_;
    std::vector<Step> steps_;
};

/// The better fit of the rectangle as given and turned.
std::optional<Skyline::Fit> fit_on(const Skyline& plate, double width, double depth, bool turns) {
    std::optional<Skyline::Fit> fit = plate.find(width, depth);
    std::optional<Skyline::Fit> turned = turns ? plate.find(depth, width) : std::nullopt;
    if (!turned || (fit && std::tie(fit->top, fit->x) <= std::tie(turned->top, turned->x))) return fit;
    turned->turned = true;
    return turned;
}

} // namespace

std::vector<std::optional<NestPlace>> nest(std::span<const NestRectangle> rectangles, const NestSettings& s) {
    const auto longer = [&](std::size_t i) { return std::max(rectangles[i].width, rectangles[i].depth); };
    const auto shorter = [&](std::size_t i) { return std::min(rectangles[i].width, rectangles[i].depth); };
    std::vector<std::size_t> order(rectangles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::make_tuple(longer(a), shorter(a)) > std::make_tuple(longer(b), shorter(b));
    });
    std::vector<std::optional<NestPlace>> places(rectangles.size());
    std::vector<Skyline> plates;
    // Each rectangle has the spacing at its right and upper side, and so has the plate.
    const Skyline empty(s.width + s.spacing, s.depth + s.spacing);
    for (const std::size_t i : order) {
        const double width = rectangles[i].width + s.spacing, depth = rectangles[i].depth + s.spacing;
        if (!fit_on(empty, width, depth, s.turns)) continue;
        for (std::size_t p = 0; p < s.plates && !places[i]; ++p) {
            if (p == plates.size()) plates.push_back(empty);
            const std::optional<Skyline::Fit> fit = fit_on(plates[p], width, depth, s.turns);
            if (!fit) continue;
            plates[p].add(fit->x, fit->turned ? depth : width, fit->top);
            places[i] = NestPlace{p, fit->x, fit->y, fit->turned};
        }
    }
    return places;
}

} // namespace facetmill
