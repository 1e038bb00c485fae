#pragma once
// Parts with one and the same mesh, as the instances of a glTF mesh are: what is done to one of them need not
// be done again.

#include "mesh/scene.hpp"

namespace facetmill {

/// [parts] The first part whose mesh equals that of each, to the bit, with its attributes and primitives,
/// wherever both stand; its own number for a part that is the first. O(data).
std::vector<std::size_t> first_with_equal_mesh(const Scene& scene);

} // namespace facetmill
