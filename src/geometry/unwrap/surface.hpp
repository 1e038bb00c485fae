#pragma once
// The triangles of all meshes in one table, and the shape of each in its own plane.

#include "geometry/polygon/polygon.hpp"
#include "geometry/unwrap/unwrap.hpp"

namespace facetmill::unwrap_room {

/// A triangle in its plane: corners at (0, 0), (length, 0) and (x, height).
struct FlatShape {
    double length = 1, x = 0, height = 1;

    Vec2 corner(std::size_t i) const { return i == 0 ? Vec2{} : i == 1 ? Vec2{length, 0} : Vec2{x, height}; }
    /// The vector from corner i to the next.
    Vec2 edge(std::size_t i) const { return corner((i + 1) % 3) - corner(i); }
    /// The cotangent of the angle opposite to edge i.
    double cotangent(std::size_t i) const {
        const Vec2 u = corner(i) - corner((i + 2) % 3), v = corner((i + 1) % 3) - corner((i + 2) % 3);
        return dot(u, v) / (length * height);
    }
    double area() const { return length * height / 2; }
};

constexpr Index next_of(Index corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

struct UnwrapSurface {
    std::vector<Vec3> positions;      ///< in the world, relative to their centre
    std::vector<Index> corner_vertex; ///< [3 * faces]
    std::vector<Index> twin; ///< [3 * faces] the corner along the same edge of the only neighbour, or none
    std::vector<Vec3> area_vectors;    ///< [faces] normals, as long as twice the area
    std::vector<FlatShape> shapes;     ///< [faces] thin triangles are given a height
    std::vector<std::uint8_t> is_thin; ///< [faces]
    std::vector<Index> mesh_begin;     ///< [meshes + 1] the first face of each mesh
    double unit = 1;                   ///< the length in the world of 1
    double edge_unit = 1;              ///< length that faces without any area get

    std::size_t face_count() const { return area_vectors.size(); }
    const Vec3& point(Index corner) const { return positions[corner_vertex[corner]]; }
    double edge_length(Index corner) const { return length(point(next_of(corner)) - point(corner)); }
};

[[nodiscard]] UnwrapSurface surface_of(std::span<const UnwrapInput> inputs);

} // namespace facetmill::unwrap_room
