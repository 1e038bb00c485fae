#pragma once
// The grid cells that marked faces touch: a fast test that most other faces are far from all of them.

#include "mesh/mesh.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

namespace facetmill::clean_steps {

/// A cell of a grid: its number along each axis.
using Cell = std::array<std::uint8_t, 3>;
/// The cells that the box of a face touches.
struct CellRange {
    Cell low, high;
};
constexpr std::size_t cells_along = 64; ///< cells along each axis

/// The grid cells of each face of a mesh. Parts outside the box belong to the first or the last cell along an
/// axis, which contain nothing else. Cell numbers are monotonic, so boxes that meet have a common cell.
class FaceCells {
  public:
    FaceCells(const Mesh& mesh, const Box& box) : box_(box), ranges_(mesh.face_count()) {
        const Vec3 extent = box_.extent();
        for (std::size_t axis = 0; axis < 3; ++axis)
            scale_[axis] = extent[axis] > 0 ? (cells_along - 2) / extent[axis] : 0;
        std::vector<Cell> of_vertex(mesh.vertex_count());
        parallel_for(of_vertex.size(), [&](std::size_t v) { of_vertex[v] = of(mesh.positions[v]); });
        parallel_for(ranges_.size(), [&](std::size_t i) {
            const auto f = static_cast<Index>(i);
            const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
            CellRange r{of_vertex[mesh.vertex(begin)], of_vertex[mesh.vertex(begin)]};
            for (Index c = begin + 1; c < end; ++c)
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const std::uint8_t at = of_vertex[mesh.vertex(c)][axis];
                    r.low[axis] = std::min(r.low[axis], at);
                    r.high[axis] = std::max(r.high[axis], at);
                }
            ranges_[f] = r;
        });
    }

    const CellRange& operator[](std::size_t face) const { return ranges_[face]; }
    Cell of(const Vec3& p) const { return {along(p, 0), along(p, 1), along(p, 2)}; }

  private:
    std::uint8_t along(const Vec3& p, std::size_t axis) const {
        constexpr std::uint8_t last = cells_along - 1;
        const double x = p[axis];
        if (!(x >= box_.min[axis])) return 0;
        if (!(x <= box_.max[axis])) return last;
        const double at = 1 + (x - box_.min[axis]) * scale_[axis];
        return at < last - 1 ? static_cast<std::uint8_t>(at) : last - 1;
    }

    Box box_;
    Vec3 scale_;
    std::vector<CellRange> ranges_; ///< [faces] ranges of cells
};

/// Any thread may mark ranges; queries are valid once all are marked.
class TouchedCells {
  public:
    void mark(const CellRange& range) {
        visit(range, [&](std::size_t row, std::uint64_t bits) {
            const std::atomic_ref shared(rows_[row]);
            if ((shared.load(std::memory_order_relaxed) & bits) != bits)
                shared.fetch_or(bits, std::memory_order_relaxed);
            return false;
        });
    }
    /// False if the range touches no marked cell.
    bool may_meet(const CellRange& range) const {
        return visit(range, [&](std::size_t row, std::uint64_t bits) { return (rows_[row] & bits) != 0; });
    }
    /// The marked cells of a row along the last axis, as bits. Rows are ordered along the first, then the
    /// middle axis: cells_along rows for each position on the first.
    std::uint64_t row(std::size_t i) const { return rows_[i]; }

  private:
    /// Calls stop(row, bits of the range) for each row until it returns true. Returns whether it did.
    template <class Stop>
    static bool visit(const CellRange& range, Stop&& stop) {
        constexpr std::uint64_t all = ~std::uint64_t{0};
        const std::uint64_t bits = all >> (cells_along - 1 - range.high[2]) & all << range.low[2];
        for (std::size_t x = range.low[0]; x <= range.high[0]; ++x)
            for (std::size_t y = range.low[1]; y <= range.high[1]; ++y)
                if (stop(x * cells_along + y, bits)) return true;
        return false;
    }

    /// Each number has the cells along the last axis as bits.
    std::vector<std::uint64_t> rows_ = std::vector<std::uint64_t>(cells_along * cells_along, 0);
};

} // namespace facetmill::clean_steps
