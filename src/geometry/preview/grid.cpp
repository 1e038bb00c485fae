#include "geometry/preview/grid.hpp"

#include "base/math/simd.hpp"
#include "mesh/finite_box.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <unordered_set>

namespace facetmill {

namespace {

/// Numbers 63-bit keys in the order of their first occurrence.
class Numbers {
  public:
    Index of(std::uint64_t key) {
        if (2 * count_ >= keys_.size()) grow();
        const std::size_t at = place(key);
        if (keys_[at] == free) {
            keys_[at] = key;
            numbers_[at] = count_++;
        }
        return numbers_[at];
    }
    std::size_t count() const { return count_; }

  private:
    static constexpr std::uint64_t free = ~std::uint64_t{0};

    std::size_t place(std::uint64_t key) const {
        const std::size_t mask = keys_.size() - 1;
        std::size_t at = (key ^ key >> 32) * 0x9e3779b97f4a7c15U >> 20 & mask;
        while (keys_[at] != free && keys_[at] != key) at = (at + 1) & mask;
        return at;
    }
    void grow() {
        const auto keys = std::exchange(keys_, std::vector<std::uint64_t>(4 * keys_.size(), free));
        const auto numbers = std::exchange(numbers_, std::vector<Index>(keys_.size()));
        for (std::size_t i = 0; i < keys.size(); ++i) {
            if (keys[i] == free) continue;
            const std::size_t at = place(keys[i]);
            keys_[at] = keys[i];
            numbers_[at] = numbers[i];
        }
    }

    std::vector<std::uint64_t> keys_ = std::vector<std::uint64_t>(1024, free);
    std::vector<Index> numbers_ = std::vector<Index>(1024);
    Index count_ = 0;
};

/// The grid cells of vertices.
class Cells {
  public:
    Cells(const Box& box, double edge) : least_(box.min) {
        const Vec3 size = box.extent();
        // 21 bits for each coordinate of a cell.
        edge_ = std::max({edge, size.x / most, size.y / most, size.z / most});
    }

    /// The key of the cell of a finite point, and its squared distance from the cell's centre, in cells.
    std::pair<std::uint64_t, double> place(const Vec3& p) const {
        std::uint64_t key = 0;
        double off = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double at = (p[i] - least_[i]) / edge_;
            const std::uint64_t cell = edge_ > 0 ? static_cast<std::uint64_t>(std::min(at, most)) : 0;
            const double d = at - static_cast<double>(cell) - 0.5;
            key = key << 21 | cell;
            off += d * d;
        }
        return {key, off};
    }

  private:
    static constexpr double most = (1 << 21) - 2;

    Vec3 least_;
    double edge_;
};

struct HashOfThree {
    std::size_t operator()(const std::array<Index, 3>& t) const {
        std::uint64_t h = t[0];
        h = (h ^ h >> 29) * 0xbf58476d1ce4e5b9U + t[1];
        h = (h ^ h >> 32) * 0x94d049bb133111ebU + t[2];
        return (h ^ h >> 31) * 0xbf58476d1ce4e5b9U;
    }
};

/// The same triangle, rotated so that its lowest number is first.
std::array<Index, 3> turned(std::array<Index, 3> t) {
    while (t[0] > t[1] || t[0] > t[2]) t = {t[1], t[2], t[0]};
    return t;
}

/// The cell of a vertex.
struct InCell {
    Index cell;       ///< the number of the cell; none if the vertex is not finite
    float off_centre; ///< squared distance from the centre, in cells
};

/// [vertices] The cells by position. All threads compute the keys of a block, and a single thread numbers
/// them.
template <class Place>
std::vector<InCell> in_cells(std::size_t vertices, const Place& place, const Cells& cells, Numbers& numbers) {
    constexpr std::size_t block = std::size_t{1} << 16;
    std::vector<InCell> out(vertices);
    std::vector<std::uint64_t> keys(std::min(block, vertices));
    for (std::size_t first = 0; first < vertices; first += block) {
        const std::size_t count = std::min(block, vertices - first);
        parallel_for(count, [&](std::size_t i) {
            const Vec3 p = place(first + i);
            const auto [key, off_centre] = is_finite(p) ? cells.place(p) : std::pair{std::uint64_t{0}, 0.0};
            keys[i] = key;
            out[first + i] = {is_finite(p) ? 0 : none, static_cast<float>(off_centre)};
        });
        for (std::size_t i = 0; i < count; ++i)
            if (out[first + i].cell != none) out[first + i].cell = numbers.of(keys[i]);
    }
    return out;
}

} // namespace

std::vector<Index> corners_in_cells(const Mesh& triangles, const Transform& to_world, double cell) {
    const auto place = [&](std::size_t v) { return to_world.point(triangles.positions[v]); };
    const Cells cells(box_of_finite(triangles.vertex_count(), place), cell);
    Numbers numbers;
    const std::vector<InCell> in_cell = in_cells(triangles.vertex_count(), place, cells, numbers);
    struct Nearest {
        Index corner = none;
        float off_centre = HUGE_VALF;
    };
    std::vector<Nearest> nearest(numbers.count());
    std::vector<Index> out; // cells, then a corner for each
    std::unordered_set<std::array<Index, 3>, HashOfThree> met;
    constexpr Index ahead = 48; // corners to prefetch ahead, because they may be anywhere in a large mesh
    for (Index c = 0; c + 2 < triangles.corner_count(); c += 3) {
        std::array<Index, 3> t{};
        for (Index k = 0; k < 3; ++k) {
            if (c + ahead + k < triangles.corner_count())
                fetch_soon(in_cell[triangles.vertex(c + ahead + k)]);
            const InCell& own = in_cell[triangles.vertex(c + k)];
            t[k] = own.cell;
            if (own.cell != none && own.off_centre < nearest[own.cell].off_centre)
                nearest[own.cell] = {c + k, own.off_centre};
        }
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
        if (t[0] == none || t[1] == none || t[2] == none || !met.insert(turned(t)).second) continue;
        out.insert(out.end(), t.begin(), t.end());
    }
    for (Index& cell : out) cell = nearest[cell].corner;
    return out;
}

} // namespace facetmill
