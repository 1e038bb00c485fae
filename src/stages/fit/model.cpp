#include "stages/fit/model.hpp"

#include "base/math/portable_math.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill::fit_stage {

namespace {

/// Interpolates on a logarithmic scale, where curves of bytes and differences are nearly straight.
double between(double a, double b, double share) {
    constexpr double least = 1e-9; // below any visible difference, and positive
    if (!(a > 0 && b > 0)) return a + share * (b - a);
    a = std::max(a, least);
    b = std::max(b, least);
    return exponential((1 - share) * logarithm(a) + share * logarithm(b));
}

/// Orders by bytes, and keeps the choices that nothing smaller beats.
template <class T>
void keep_best(std::vector<T>& all) {
    std::stable_sort(all.begin(), all.end(), [](const T& a, const T& b) {
        return a.cost.bytes != b.cost.bytes ? a.cost.bytes < b.cost.bytes : a.cost.error < b.cost.error;
    });
    std::size_t kept = 0;
    for (const T& one : all)
        if (kept == 0 || one.cost.error < all[kept - 1].cost.error) all[kept++] = one;
    all.resize(kept);
}

std::vector<MeasuredRatio> dense(const std::vector<MeasuredRatio>& measured) {
    std::vector<MeasuredRatio> all;
    constexpr int steps = 8;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        all.push_back(measured[i]);
        for (int k = 1; k < steps && i + 1 < measured.size(); ++k) {
            const MeasuredRatio &a = measured[i], &b = measured[i + 1];
            const double share = static_cast<double>(k) / steps;
            // The first collapses already change pictures, so differences are interpolated linearly.
            all.push_back({between(a.keep, b.keep, share),
                           {between(a.cost.bytes, b.cost.bytes, share),
                            a.cost.error + share * (b.cost.error - a.cost.error)}});
        }
    }
    return all;
}

std::vector<MeasuredImages> dense(const std::vector<MeasuredImages>& measured) {
    std::vector<MeasuredImages> all;
    constexpr int step = 5; // of quality
    for (std::size_t i = 0; i < measured.size(); ++i) {
        all.push_back(measured[i]);
        if (i + 1 == measured.size()) break;
        const MeasuredImages &a = measured[i], &b = measured[i + 1];
        if (a.choice.side != b.choice.side) continue;
        for (int quality = a.choice.quality - step; quality > b.choice.quality; quality -= step) {
            const double share =
                static_cast<double>(a.choice.quality - quality) / (a.choice.quality - b.choice.quality);
            // Relative bytes may be negative, so they are interpolated linearly.
            all.push_back({{a.choice.side, quality},
                           {a.cost.bytes + share * (b.cost.bytes - a.cost.bytes),
                            between(a.cost.error, b.cost.error, share)}});
        }
    }
    return all;
}

} // namespace

Model::Model(const Curves& curves, double weight) {
    for (const MeasuredRatio& ratio : dense(curves.ratios))
        for (const MeasuredBits& p : curves.position)
            for (const MeasuredBits& n : curves.normal)
                for (const MeasuredBits& u : curves.uv) {
                    const double left = std::max(0.1, 1 - p.saved - n.saved - u.saved);
                    shapes_.push_back(
                        {ratio.keep,
                         {p.bits, n.bits, u.bits},
                         {ratio.cost.bytes * left, ratio.cost.error * weight + p.error + n.error + u.error}});
                }
    for (const MeasuredImages& c : dense(curves.colours))
        for (const MeasuredImages& n : dense(curves.normals))
            images_.push_back(
                {c.choice, n.choice, {c.cost.bytes + n.cost.bytes, c.cost.error + n.cost.error}});
    keep_best(shapes_);
    keep_best(images_);
}

Choice Model::choice_of(const Shape& shape, const Images& images) {
    return {shape.keep, shape.bits, images.colours, images.normals};
}

std::optional<Choice> Model::best_within(double bytes) const {
    std::optional<Choice> best;
    double least = HUGE_VAL;
    for (const Images& images : images_) {
        const double left = bytes - images.cost.bytes;
        const auto after = std::partition_point(shapes_.begin(), shapes_.end(),
                                                [&](const Shape& s) { return s.cost.bytes <= left; });
        if (after == shapes_.begin()) continue;
        const Shape& shape = *(after - 1);
        const double error = shape.cost.error + images.cost.error;
        if (error < least) {
            least = error;
            best = choice_of(shape, images);
        }
    }
    return best;
}

std::optional<Choice> Model::smallest_within(double error) const {
    std::optional<Choice> best;
    double fewest = HUGE_VAL;
    for (const Images& images : images_) {
        const double left = error - images.cost.error;
        const auto shape = std::partition_point(shapes_.begin(), shapes_.end(),
                                                [&](const Shape& s) { return s.cost.error > left; });
        if (shape == shapes_.end()) continue;
        const double bytes = shape->cost.bytes + images.cost.bytes;
        if (bytes < fewest) {
            fewest = bytes;
            best = choice_of(*shape, images);
        }
    }
    return best;
}

Choice Model::smallest() const { return choice_of(shapes_.front(), images_.front()); }

} // namespace facetmill::fit_stage
