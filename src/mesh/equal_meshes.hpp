#pragma once
// Parts with one and the same mesh, as the instances of a glTF mesh are: what is done to one of them need not
// be done again.

#include "mesh/scene.hpp"

#include <array>

namespace facetmill {

/// [parts] The first part whose mesh equals that of each, to the bit, with its attributes and primitives,
/// wherever both stand; its own number for a part that is the first. O(data).
std::vector<std::size_t> first_with_equal_mesh(const Scene& scene);

/// Where the axes of a space point in the world, and how long they are: the same for spaces that differ by a
/// move.
std::array<double, 9> axes_in_world(const Transform& to_world);

/// [parts] As first_with_equal_mesh, of parts that stand the same but for a move: in the world all of one are
/// one shape.
std::vector<std::size_t> first_with_equal_shape(const Scene& scene);

} // namespace facetmill
