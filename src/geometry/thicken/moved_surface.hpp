#pragma once
// Effects of moving a surface along its normals: faces that turn over, and closed components that vanish.

#include "mesh/mesh.hpp"

#include <cstdint>
#include <vector>

namespace facetmill {

/// The largest share of a face's area, or of an edge's length, that can result from rounding its corners.
inline constexpr double collapse_rounding = 0x1p-40;

/// [faces] 1 if the move turns the face over. L is the linear map from a triangle's sides to the moved
/// sides, seen along the normal. Polygons use one of their triangles. A face is turned if an eigenvalue of L
/// has no positive real part. This holds if the determinant or the trace is at most collapse_rounding. Such a
/// face shrank to nothing during the move, in one direction or in both, as at a focal set. Faces without area
/// are not turned. moved: the new vertex positions, in the same space.
[[nodiscard]] std::vector<std::uint8_t> turned_faces(const Mesh& mesh, const std::vector<Vec3>& moved);

/// The answer of room_inside.
enum class Room { none, some, unknown };

/// Whether a closed, outward oriented component contains a ball with the depth as radius. The search divides
/// space into ever smaller cells. The distance changes no faster than the position, so most cells need no
/// division. A ball with less than a thousandth (2^-10) of its radius to spare counts as none. The answer is
/// unknown after 100,000 cells. Requires finite positions.
[[nodiscard]] Room room_inside(const Mesh& component, double depth);

/// [faces] 1 for components that vanish in a move by the distance along the normals (negative: against
/// them). Such a component is closed, has turned faces, shrinks in the move, and contains no ball of that
/// radius. Nothing remains of its solid. The mesh is in world space. Parallel.
[[nodiscard]] std::vector<std::uint8_t>
vanished_components(const Mesh& mesh, const std::vector<std::uint8_t>& turned, double distance);

} // namespace facetmill
