#pragma once
// What becomes of a surface that is moved along its normals: where it turns over, and which closed components
// have no room left for it.

#include "mesh/mesh.hpp"

#include <cstdint>
#include <vector>

namespace facetmill {

/// [faces] 1 where the move turns a face over. With L the linear map that takes the sides of a triangle to
/// where they are moved, seen along its normal (polygons: of one of the triangles that it is cut into), a
/// face is turned when an eigenvalue of L has no positive real part: determinant or trace is zero or
/// less, or no more than 2^-40, which is rounding.
/// Then it shrank to nothing somewhere on the way, in one direction or in both: where the faces of a focal
/// set meet. Faces without area are not turned. moved: the places of the vertices; both in one space.
[[nodiscard]] std::vector<std::uint8_t> turned_faces(const Mesh& mesh, const std::vector<Vec3>& moved);

/// What there is inside a closed component.
enum class Room { none, some, unknown };

/// Whether a point inside the closed, outward oriented component is farther from it than the depth: none when
/// no ball of that radius fits into it. A search through ever smaller cells: the distance cannot change by
/// more than the way, so most are judged whole. A ball that fits but has less than a thousandth (2^-10) of
/// its radius to spare counts as none; unknown after 100,000 cells. Requires finite positions.
[[nodiscard]] Room room_inside(const Mesh& component, double depth);

/// Of the components of a mesh in world space that a move by the distance along the normals (negative:
/// against them) turned in part: [faces] 1 for those that are closed, become smaller by the move, and have no
/// room inside for one that deep. Nothing is left of what such a component bounds. Parallel.
[[nodiscard]] std::vector<std::uint8_t>
vanished_components(const Mesh& mesh, const std::vector<std::uint8_t>& turned, double distance);

} // namespace facetmill
