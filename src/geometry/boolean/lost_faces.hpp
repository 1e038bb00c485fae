#pragma once
// What of two operands surely bounds nothing of what they are combined to, found before anything is cut.

#include "geometry/boolean/combine.hpp"

#include <cstdint>
#include <span>

namespace facetmill::clean_steps {

/// [faces] 1 for faces of which nothing stays, whatever intersects them; empty where none are known. second:
/// [faces] 1 for those of the second operand. Both operands should be closed, consistently oriented and
/// without faces of no area, as is checked later: else this says nothing.
///
/// Cells of a grid that no box of one operand's faces touches, and that hang together side by side, are a
/// *room*: that operand winds around all of its points equally often. Faces of the other operand that are in
/// a room are lost where that is once at least, of a union, and of what something is taken away from; where
/// it is not even once, of an intersection, and of what is taken away: on both of their sides there is
/// nothing but what the other decides. How often it is, a ray from a vertex in the room tells (exact); of
/// rooms with few faces nothing is said.
///
/// **Pairs of one operand with a lost face need not be known.** Let K be the open set of the points that are
/// not on the other operand, around which it winds as above. All that is not known of an operand's faces lies
/// in its K, since a point of a lost face does. A leaf of that operand (a piece or an uncut face) lies in K
/// or has no point in it, for K ends at the other's faces only, and along those all is cut. One in K goes,
/// and is found to go, wherever on it one asks: a ray counts exactly how often the other winds, because the
/// point is on none of its faces. What it is joined with beyond an edge that no other leaf has is in K, too.
/// All other leaves are cut along all that they meet. Parallel; the same for any number of threads.
std::vector<std::uint8_t> lost_faces(const Mesh& mesh, std::span<const std::uint8_t> second,
                                     CombineOperation operation);

} // namespace facetmill::clean_steps
