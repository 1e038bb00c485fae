#include "geometry/intersect/plain_stars.hpp"

#include "base/math/simd.hpp"
#include "geometry/intersect/disjoint_triangles.hpp"
#include "mesh/buckets.hpp"

#include <optional>
#include <span>

namespace facetmill {

namespace {

/// The triangles around a vertex, each as the two corners that follow the vertex.
class Sectors {
  public:
    void begin() { count_ = 0; }
    void add(std::span<const Vec3> positions, Index vertex, Index from, Index to) {
        if (count_ < most) {
            const Vec3 &v = positions[vertex], a = positions[from] - v, b = positions[to] - v;
            for (std::size_t k = 0; k < 3; ++k) {
                a_[k][count_] = a[k];
                b_[k][count_] = b[k];
            }
            from_[count_ / 4][count_ % 4] = static_cast<std::int32_t>(from);
            to_[count_] = static_cast<std::int32_t>(to);
        }
        ++count_;
    }

    /// Projects along the axis that the first triangle faces most. This is nearly always as good as the axis
    /// of all triangles.
    Star kind() const {
        if (count_ > most) return Star::unknown;
        const std::size_t quick = axis(1);
        std::optional<std::size_t> laps = laps_along(quick);
        if (!laps)
            if (const std::size_t best = axis(count_); best != quick) laps = laps_along(best);
        return laps ? kind_of(*laps) : Star::unknown;
    }

  private:
    static constexpr std::size_t most = 24; ///< stars with more triangles are not classified

    /// The axis that the first triangles face most, by the sum of their areas.
    std::size_t axis(std::size_t first) const {
        Vec3 sum;
        for (std::size_t i = 0; i < first; ++i)
            sum = sum + cross({a_[0][i], a_[1][i], a_[2][i]}, {b_[0][i], b_[1][i], b_[2][i]});
        const double x = std::abs(sum.x), y = std::abs(sum.y), z = std::abs(sum.z);
        return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    }

    /// The number of sectors, projected along the axis, that reach or pass a half-axis from before it. None
    /// unless all sectors certainly turn in the same direction.
    std::optional<std::size_t> laps_along(std::size_t axis) const {
        const auto &au = a_[(axis + 1) % 3], &av = a_[(axis + 2) % 3];
        const auto &bu = b_[(axis + 1) % 3], &bv = b_[(axis + 2) % 3];
        std::size_t left = 0, right = 0, left_laps = 0, right_laps = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const int turn = sure_sign(au[i] * bv[i], av[i] * bu[i]);
            left += turn > 0;
            right += turn < 0;
            left_laps += static_cast<std::size_t>(av[i] < 0) & static_cast<std::size_t>(bv[i] >= 0);
            right_laps += static_cast<std::size_t>(bv[i] < 0) & static_cast<std::size_t>(av[i] >= 0);
        }
        if (left == count_) return left_laps;
        if (right == count_) return right_laps;
        return {};
    }

    /// A single ring goes round once: two rings would pass the half-axis twice. Triangles that begin after
    /// the half-axis and do not reach it again go round less than once.
    Star kind_of(std::size_t laps) const {
        if (laps > 1) return Star::unknown;
        const std::uint32_t all = (std::uint32_t{1} << count_) - 1;
        std::uint32_t followed = 0; // sectors with a sector before them
        std::size_t ends = 0;       // sectors without a sector after them
        for (std::size_t i = 0; i < count_; ++i) {
            std::uint32_t next = 0;
            for (std::size_t at = 0; at < count_; at += 4)
                next |= bits_of(from_[at / 4] == Int4{} + to_[i]) << at;
            next &= all;
            if ((next & (next - 1)) != 0 || (next & followed) != 0) return Star::unknown;
            followed |= next;
            ends += next == 0;
        }
        if (ends == 0) return laps == 1 ? Star::ring : Star::unknown;
        return ends == 1 && laps == 0 && are_apart() ? Star::plain : Star::unknown;
    }
    /// Whether no two sectors begin with the same vertex, and no two end with the same vertex.
    bool are_apart() const {
        for (std::size_t i = 0; i < count_; ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (from_[i / 4][i % 4] == from_[j / 4][j % 4] || to_[i] == to_[j]) return false;
        return true;
    }

    std::size_t count_ = 0;
    double a_[3][most], b_[3][most];
    Int4 from_[most / 4];
    std::int32_t to_[most];
};

Index next_in_triangle(Index c) { return c % 3 == 2 ? c - 2 : c + 1; }

} // namespace

std::vector<Star> plain_stars(std::span<const Vec3> positions, std::span<const Index> corners) {
    const auto buckets = fill_buckets<Index>(corners.size() / 3, positions.size(), [&](Index t, auto&& emit) {
        for (Index c = 3 * t; c < 3 * t + 3; ++c) emit(corners[c], c);
    });
    std::vector<Star> stars(positions.size(), Star::unknown);
    parallel_chunks(
        buckets.count(),
        [&](std::size_t first, std::size_t last) {
            std::vector<Index> begin, order;
            Sectors around;
            for (std::size_t b = first; b < last; ++b) {
                const auto here = buckets.of(b); // corners at the vertex
                const auto lowest = static_cast<Index>(buckets.first_vertex(b));
                begin.assign((std::size_t{1} << buckets.shift) + 1, 0);
                for (const Index c : here) ++begin[corners[c] - lowest];
                exclusive_scan(begin);
                order.resize(here.size());
                for (const Index c : here) order[begin[corners[c] - lowest]++] = c;
                for (std::size_t i = 0; i < order.size();) { // begin[v] is now the end of v
                    const Index v = corners[order[i]];
                    around.begin();
                    for (; i < begin[v - lowest]; ++i) {
                        const Index from = next_in_triangle(order[i]);
                        around.add(positions, v, corners[from], corners[next_in_triangle(from)]);
                    }
                    stars[v] = around.kind();
                }
            }
        },
        buckets.at_once());
    return stars;
}

} // namespace facetmill
