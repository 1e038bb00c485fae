#pragma once
// Finds faces that certainly do not bound the result of a boolean operation, before anything is cut.

#include "geometry/boolean/combine.hpp"

#include <cstdint>
#include <span>

namespace facetmill::clean_steps {

/// [faces] 1 for faces without any part in the result, whatever intersects them; empty if none are known.
/// second: [faces] 1 for faces of the second operand. Both operands should be closed, consistently oriented
/// and without zero-area faces. This is checked later; otherwise the result is meaningless.
///
/// A *room* is a connected set of grid cells that no box of one operand's faces touches. That operand has a
/// constant winding number in the room. The other operand's faces in the room are lost when the number
/// decides both of their sides. At a number of at least 1 this is true for a union, and for faces of the
/// minuend. Below 1 it is true for an intersection, and for faces of the subtrahend. An exact ray from a
/// vertex in the room determines the number. Rooms with few faces are skipped.
///
/// **Pairs of two faces of the same operand may be skipped if one is lost.** Let K be the open set of points
/// off the other operand where its winding number decides as above. A lost face has a point in K, and all
/// skipped intersections of its operand are in its K. K ends only at the other operand's faces, and
/// everything is cut along these. So a leaf (a piece or an uncut face) of the operand is entirely in K or
/// has no point in K. A leaf in K is removed, and any test point shows that. A ray counts exactly how often
/// the other operand winds, because the point is on none of its faces. Its neighbour across an edge without
/// other leaves is also in K. All other leaves are cut along all faces that they meet.
///
/// Parallel; the result does not depend on the number of threads.
[[nodiscard]] std::vector<std::uint8_t> lost_faces(const Mesh& mesh, std::span<const std::uint8_t> second,
                                                   CombineOperation operation);

} // namespace facetmill::clean_steps
