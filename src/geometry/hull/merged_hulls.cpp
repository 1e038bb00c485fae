#include "geometry/hull/merged_hulls.hpp"

#include "geometry/hull/cut_sweep.hpp"
#include "geometry/hull/enclosing.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace facetmill {

namespace {

/// With more hulls, testing every pair would take too long.
constexpr std::size_t most_pairs_of = 64;

MergedHull joined(const MergedHull& a, const MergedHull& b) {
    std::vector<Vec3> points = a.hull.points;
    points.insert(points.end(), b.hull.points.begin(), b.hull.points.end());
    MergedHull out{a.leaves, simple_hull(points), 0};
    out.leaves.insert(out.leaves.end(), b.leaves.begin(), b.leaves.end());
    out.volume = volume_of(out.hull);
    return out;
}

double volume_of_box(const Box& box) {
    const Vec3 e = box.extent();
    return e.x * e.y * e.z;
}

/// Joins the smallest hull with the one whose common box is smallest, until few are left.
void join_small(std::vector<MergedHull>& hulls, std::size_t most) {
    std::vector<Box> boxes;
    boxes.reserve(hulls.size());
    for (const MergedHull& h : hulls) boxes.push_back(box_of(h.hull.points));
    while (hulls.size() > most) {
        const auto smallest =
            std::min_element(hulls.begin(), hulls.end(),
                             [](const MergedHull& a, const MergedHull& b) { return a.volume < b.volume; });
        const auto i = static_cast<std::size_t>(smallest - hulls.begin());
        std::size_t with = none;
        double least = HUGE_VAL;
        for (std::size_t j = 0; j < hulls.size(); ++j) {
            if (j == i) continue;
            Box both = boxes[i];
            both.add(boxes[j]);
            const double more = volume_of_box(both) - volume_of_box(boxes[j]);
            if (more >= least) continue;
            least = more;
            with = j;
        }
        hulls[with] = joined(hulls[with], hulls[i]);
        boxes[with].add(boxes[i]);
        hulls.erase(hulls.begin() + static_cast<std::ptrdiff_t>(i));
        boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(i));
    }
}

/// The cost of a common hull: lower is better.
struct MergeCost {
    double concavity = HUGE_VAL, more_volume = HUGE_VAL;
    bool operator<(const MergeCost& b) const {
        return std::tie(concavity, more_volume) < std::tie(b.concavity, b.more_volume);
    }
};

/// The costs of all pairs, kept while pairs merge.
class PairCosts {
  public:
    PairCosts(const SolidGrid& grid, std::vector<MergedHull>& hulls, double concavity)
        : grid_(grid), hulls_(hulls), concavity_(concavity), n_(hulls.size()), costs_(n_ * n_), gone_(n_) {
        parallel_for(
            n_ * n_, [&](std::size_t i) { measure(i / n_, i % n_); }, 16);
    }

    /// Merges the best pair, if it is close enough or if it must.
    bool merge_best(bool must) {
        std::size_t best = n_ * n_;
        for (std::size_t i = 0; i < costs_.size(); ++i)
            if (costs_[i].concavity < HUGE_VAL && (best == costs_.size() || costs_[i] < costs_[best]))
                best = i;
        if (best == costs_.size() || (!must && costs_[best].concavity > concavity_)) return false;
        const std::size_t a = best / n_, b = best % n_;
        hulls_[a] = joined(hulls_[a], hulls_[b]);
        gone_[b] = true;
        for (std::size_t i = 0; i < n_; ++i) costs_[i * n_ + b] = costs_[b * n_ + i] = {};
        parallel_for(
            n_,
            [&](std::size_t i) {
                if (i != a && !gone_[i]) measure(std::min(i, a), std::max(i, a));
            },
            1);
        return true;
    }
    void remove_gone() {
        std::vector<MergedHull> left;
        for (std::size_t i = 0; i < n_; ++i)
            if (!gone_[i]) left.push_back(std::move(hulls_[i]));
        hulls_ = std::move(left);
    }

  private:
    void measure(std::size_t a, std::size_t b) {
        if (a >= b) return;
        const MergedHull both = joined(hulls_[a], hulls_[b]);
        const double distance = voids_of(grid_, both.hull).distance;
        costs_[a * n_ + b] = {std::max(distance, concavity_),
                              both.volume - hulls_[a].volume - hulls_[b].volume};
    }

    const SolidGrid& grid_;
    std::vector<MergedHull>& hulls_;
    double concavity_;
    std::size_t n_;
    std::vector<MergeCost> costs_; ///< [first * n + second] infinite for pairs that do not exist
    std::vector<std::uint8_t> gone_;
};

} // namespace

void merge_hulls(const SolidGrid& grid, std::vector<MergedHull>& hulls, const MergeGoal& goal) {
    join_small(hulls, std::max(most_pairs_of, goal.parts));
    if (hulls.size() < 2) return;
    PairCosts costs(grid, hulls, goal.concavity);
    std::size_t left = hulls.size();
    while (left > 1 && costs.merge_best(left > goal.parts)) --left;
    costs.remove_gone();
}

} // namespace facetmill
