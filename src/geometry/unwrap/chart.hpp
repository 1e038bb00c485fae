#pragma once
// A single chart: its triangles with points of their own, flattened and tested.

#include "geometry/unwrap/surface.hpp"

#include <Eigen/Core>
#include <array>

namespace facetmill::unwrap_room {

/// Glue between faces. Corners of a chart are only written by the thread that works on the chart.
struct Gluing {
    std::vector<std::uint8_t> glued;  ///< [corners] 1: the chart is connected over this edge; same for twins
    std::vector<Index> place_of_face; ///< [faces] number in the list of its chart
    std::vector<Vec2> at;             ///< [corners] place in the chart

    explicit Gluing(const UnwrapSurface& s)
        : glued(s.corner_vertex.size()), place_of_face(s.face_count()), at(s.corner_vertex.size()) {}
};

struct ChartMeasure {
    bool valid = false;    ///< no flipped triangle, no overlap
    UnwrapStretch stretch; ///< of all triangles that are not thin
    double area = 0;       ///< on the surface
};

/// A piece of the border of a chart, in the direction of its face.
struct BorderEdge {
    Index from, to; ///< points
    Index corner;   ///< of the chart
};

class FlatChart {
  public:
    /// Reads glue, and numbers the faces in `gluing`.
    FlatChart(const UnwrapSurface& surface, Gluing& gluing, std::span<const Index> faces);

    /// Starts from the projection along the mean normal.
    void project();
    /// Starts from the mean of the places of the corners in the gluing.
    void start_from(const Gluing& gluing);
    /// Lets every triangle be as rigid as possible. Ends after `rounds` or when the points hardly move.
    void relax(int rounds);
    /// Moves the corners of flipped triangles until none is flipped, if that is easy.
    void untangle();
    /// Scales the chart to its area on the surface, and measures it. Exact tests decide whether it is valid.
    [[nodiscard]] ChartMeasure measure();
    /// Writes the places of the corners.
    void store(Gluing& gluing) const;

    std::vector<Vec2>& points() { return points_; }
    const std::vector<Index>& corners() const { return corners_; }
    const std::vector<BorderEdge>& border() const { return border_; }

  private:
    void find_border(const Gluing& gluing);
    /// The right side of the global step: every triangle turned rigidly.
    void pull_rigidly(const std::vector<double>& weights, Eigen::MatrixX2d& right) const;
    const FlatShape& shape(std::size_t place) const { return surface_.shapes[faces_[place]]; }
    Vec2 corner(std::size_t place, std::size_t i) const { return points_[corners_[3 * place + i]]; }
    /// Twice the area of a triangle in the texture.
    double doubled_area(std::size_t place) const {
        return cross(corner(place, 1) - corner(place, 0), corner(place, 2) - corner(place, 0));
    }

    const UnwrapSurface& surface_;
    std::span<const Index> faces_;
    std::vector<Index> corners_; ///< [3 * faces] points
    std::vector<Vec2> points_;
    std::vector<BorderEdge> border_;
};

/// Whether all triangles turn left. corners: [3 * faces] points. Exact.
[[nodiscard]] bool all_turn_left(const std::vector<Index>& corners, const std::vector<Vec2>& points);
/// Whether the border neither crosses nor touches itself, and has a single outer loop. A chart without
/// flipped triangles then covers no point twice. Exact.
[[nodiscard]] bool is_simple_border(const std::vector<BorderEdge>& border, const std::vector<Vec2>& points);

} // namespace facetmill::unwrap_room
