#include "geometry/intersect/plain_stars.hpp"

#include "geometry/intersect/disjoint_triangles.hpp"
#include "mesh/buckets.hpp"

#include <span>

namespace facetmill {

namespace {

/// A triangle at a vertex: its two other vertices, in its order.
struct Sector {
    Index vertex, from, to;
};

/// The sectors around a vertex, with their corners as seen from it.
class Sectors {
  public:
    void begin() { count_ = 0; }
    void add(std::span<const Vec3> positions, const Sector& s) {
        if (count_ < most) {
            const Vec3& v = positions[s.vertex];
            sectors_[count_] = s;
            from_[count_] = positions[s.from] - v;
            to_[count_] = positions[s.to] - v;
        }
        ++count_;
    }

    Star kind() const { return count_ <= most ? kind_of_few() : Star::unknown; }

  private:
    static constexpr std::size_t most = 24; ///< of more triangles nothing is said

    /// The axis that the triangles face most, by the sum of their areas.
    std::size_t axis() const {
        Vec3 sum;
        for (std::size_t i = 0; i < count_; ++i) sum = sum + cross(from_[i], to_[i]);
        const double x = std::abs(sum.x), y = std::abs(sum.y), z = std::abs(sum.z);
        return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    }

    Star kind_of_few() const {
        const std::size_t k = axis(), u = (k + 1) % 3, v = (k + 2) % 3;
        int way = 0;
        std::size_t laps = 0; // how often the sectors reach or pass the half-axis u, coming from below it
        for (std::size_t i = 0; i < count_; ++i) {
            const Vec3 &a = from_[i], &b = to_[i];
            const int turn = sure_sign(a[u] * b[v], a[v] * b[u]);
            if (turn == 0 || (way != 0 && turn != way)) return Star::unknown;
            way = turn;
            laps += turn > 0 ? a[v] < 0 && b[v] >= 0 : b[v] < 0 && a[v] >= 0;
        }
        std::size_t ends = 0; // sectors with none before them
        for (std::size_t i = 0; i < count_; ++i) {
            bool has_one_before = false;
            for (std::size_t j = 0; j < count_; ++j) {
                if (j != i && (sectors_[j].from == sectors_[i].from || sectors_[j].to == sectors_[i].to))
                    return Star::unknown;
                has_one_before |= sectors_[j].to == sectors_[i].from;
            }
            ends += !has_one_before;
        }
        // One ring goes round once: two would pass the half-axis twice. What begins after it and does not
        // come to it again goes round less than once.
        if (ends == 0) return laps == 1 ? Star::ring : Star::unknown;
        return ends == 1 && laps == 0 ? Star::plain : Star::unknown;
    }

    std::size_t count_ = 0;
    Sector sectors_[most];
    Vec3 from_[most], to_[most];
};

} // namespace

std::vector<Star> plain_stars(std::span<const Vec3> positions, std::span<const Index> corners) {
    const auto buckets =
        fill_buckets<Sector>(corners.size() / 3, positions.size(), [&](Index t, auto&& emit) {
            const Index* const c = &corners[std::size_t{3} * t];
            for (std::size_t i = 0; i < 3; ++i) emit(c[i], Sector{c[i], c[(i + 1) % 3], c[(i + 2) % 3]});
        });
    std::vector<Star> stars(positions.size(), Star::unknown);
    parallel_chunks(
        buckets.count(),
        [&](std::size_t first, std::size_t last) {
            std::vector<Index> begin, order;
            Sectors around;
            for (std::size_t b = first; b < last; ++b) {
                const auto sectors = buckets.of(b);
                const auto lowest = static_cast<Index>(buckets.first_vertex(b));
                begin.assign((std::size_t{1} << buckets.shift) + 1, 0);
                for (const Sector& s : sectors) ++begin[s.vertex - lowest];
                exclusive_scan(begin);
                order.resize(sectors.size());
                for (Index i = 0; i < sectors.size(); ++i) order[begin[sectors[i].vertex - lowest]++] = i;
                for (std::size_t i = 0; i < order.size();) { // begin[v] is now the end of v
                    const Index v = sectors[order[i]].vertex;
                    around.begin();
                    for (; i < begin[v - lowest]; ++i) around.add(positions, sectors[order[i]]);
                    stars[v] = around.kind();
                }
            }
        },
        buckets.at_once());
    return stars;
}

} // namespace facetmill
