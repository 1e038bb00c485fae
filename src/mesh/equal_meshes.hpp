#pragma once
// Parts with one and the same mesh, as the instances of a glTF mesh are: what is done to one of them need not
// be done again.

#include "mesh/scene.hpp"

#include <array>
#include <cstdint>

namespace facetmill {

/// [parts] The first part whose mesh equals that of each, to the bit, with its attributes and primitives,
/// wherever both stand; its own number for a part that is the first. O(data).
std::vector<std::size_t> first_with_equal_mesh(const Scene& scene);

/// Alike for numbers that are equal, and for two that are no numbers (NaN) of the same bits, which have no
/// order among the others and so cannot be keys themselves.
std::uint64_t key_of(double number);

/// The keys of where the axes of a space point in the world, and how long they are: the same for spaces that
/// differ by a move.
std::array<std::uint64_t, 9> axes_in_world(const Transform& to_world);

/// [parts] As first_with_equal_mesh, of parts that stand the same but for a move: in the world all of one are
/// one shape.
std::vector<std::size_t> first_with_equal_shape(const Scene& scene);

} // namespace facetmill
