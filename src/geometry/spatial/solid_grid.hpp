#pragma once
// A solid as cells of a grid, with the distance of every empty cell from it.

#include "mesh/surface.hpp"

#include <array>

namespace facetmill {

/// A cell, or a corner of cells, by its position along each axis.
using Cell = std::array<std::int32_t, 3>;

/// A range of cells: [low, high) along each axis.
struct CellBox {
    Cell low{}, high{};
    bool operator==(const CellBox&) const = default;
};

/// The cells that a surface touches, and those that it separates from the outside. A border of at least a
/// cell stays empty. Holes smaller than a cell do not open a solid.
class SolidGrid {
  public:
    /// About this cell size, but with at most max_cells cells.
    SolidGrid(const Surface& surface, double cell_size, std::size_t max_cells);

    double cell_size() const { return size_; }
    const Cell& cells() const { return cells_; }
    std::size_t count() const { return solid_.size(); }
    std::size_t touched() const { return touched_; } ///< cells that the surface touches
    std::size_t index(const Cell& c) const {
        return static_cast<std::size_t>(c[0]) +
               static_cast<std::size_t>(cells_[0]) *
                   (static_cast<std::size_t>(c[1]) +
                    static_cast<std::size_t>(cells_[1]) * static_cast<std::size_t>(c[2]));
    }
    /// Computes square_distance. O(cells), parallel.
    void measure_distances();
    bool solid(std::size_t index) const { return solid_[index] != 0; }
    /// The distance between the centres of a cell and the nearest cell of the solid, squared, in cells.
    std::uint32_t square_distance(std::size_t index) const { return square_distance_[index]; }
    /// A point in cells, from the corner of the first cell.
    Vec3 in_cells(const Vec3& p) const { return (p - origin_) / size_; }
    double coordinate(int axis, std::int32_t corner) const {
        return origin_[static_cast<std::size_t>(axis)] + corner * size_;
    }
    /// The cell with the point, at most one of the box.
    Cell cell_at(const Vec3& p, const CellBox& box) const;

  private:
    void mark_surface(const Surface& surface);
    void fill();

    Vec3 origin_;
    double size_ = 1;
    Cell cells_{};
    std::size_t touched_ = 0;
    std::vector<std::uint8_t> solid_;
    std::vector<std::uint32_t> square_distance_;
};

} // namespace facetmill
