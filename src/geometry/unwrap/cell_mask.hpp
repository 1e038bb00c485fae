#pragma once
// Sets of cells of a grid, 64 to a word.

#include "geometry/polygon/polygon.hpp"

#include <cstdint>

namespace facetmill::unwrap_room {

/// The cells that a chart touches; all of them in [0, width) x [0, height).
struct CellMask {
    std::size_t width = 0, height = 0, words = 0; ///< words per row
    std::vector<std::uint64_t> bits;

    void reset(std::size_t w, std::size_t h);
    void set(std::size_t x, std::size_t y) { bits[y * words + x / 64] |= std::uint64_t{1} << (x % 64); }
    bool at(std::size_t x, std::size_t y) const { return bits[y * words + x / 64] >> (x % 64) & 1; }
    void set_run(std::size_t begin, std::size_t end, std::size_t y);
};

/// Coordinates are moved by this much of a cell, and triangles are widened by it, so that rounding later
/// leaves them in their cells.
inline constexpr double cell_slack = 4e-3;

/// All cells that triangles touch. corners: points, three per triangle; coordinates from 0, in cells.
void touch_cells(const std::vector<Index>& corners, const std::vector<Vec2>& points, double scale,
                 CellMask& mask);
/// The mask after a quarter turn anticlockwise: cell (x, y) becomes (height - 1 - y, x).
void quarter_turn(const CellMask& mask, CellMask& turned);

/// The cells taken so far in a strip of fixed width that grows upward.
class OccupiedCells {
  public:
    explicit OccupiedCells(std::size_t width) : width_(width), words_(width / 64 + 2) {}

    /// The first x from `from` where the mask is free at this height, up to `last`; SIZE_MAX if none.
    std::size_t free_place(const CellMask& mask, std::size_t from, std::size_t last, std::size_t y);
    /// Takes the cells of the mask, and all within `gutter` of them.
    void take(const CellMask& mask, std::size_t x, std::size_t y, std::size_t gutter);

  private:
    /// The next x to try after a collision in this row, or x if there is none.
    std::size_t after_collision(const CellMask& mask, std::size_t row, std::size_t x, std::size_t y) const;
    std::uint64_t word_at(std::size_t bit, std::size_t y) const;
    std::size_t end_of_run(std::size_t bit, std::size_t y) const;

    std::size_t width_, words_, rows_ = 0, last_row_ = 0;
    std::vector<std::uint64_t> bits_;
};

} // namespace facetmill::unwrap_room
