#pragma once
// Finds parts with equal meshes, such as the instances of a glTF mesh, so that a result can be reused.

#include "mesh/scene.hpp"

#include <array>
#include <cstdint>

namespace facetmill {

/// [parts] The first part whose mesh equals each part's, to the bit, with its attributes and primitives,
/// whatever the transforms. A part without an earlier equal has its own number. O(data).
std::vector<std::size_t> first_with_equal_mesh(const Scene& scene);

/// Equal for equal numbers, and for two NaN of the same bits. NaN cannot be keys, because they have no
/// order.
std::uint64_t key_of(double number);

/// The keys of where the axes of a space point in the world, and how long they are: the same for spaces that
/// differ by a move.
std::array<std::uint64_t, 9> axes_in_world(const Transform& to_world);

/// [parts] Like first_with_equal_mesh, for parts whose transforms differ only by a translation: in the world
/// they have the same shape.
std::vector<std::size_t> first_with_equal_shape(const Scene& scene);

} // namespace facetmill
