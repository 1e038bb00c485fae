#pragma once
// Where the planes of a stack of sections are.

#include "mesh/plane.hpp"
#include "mesh/mesh.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace facetmill {

/// The lowest and the highest along a plane's normal, from the plane, in world units; empty when low > high.
struct Extent {
    double low = HUGE_VAL, high = -HUGE_VAL;
    void add(const Extent& other) {
        low = other.low < low ? other.low : low;
        high = other.high > high ? other.high : high;
    }
};

/// Of all vertices of a mesh. Parallel.
Extent extent_along(const Plane& plane, const Mesh& mesh, const Transform& to_world);

struct Stack {
    std::vector<double> heights{0}; ///< ascending, from the plane
    double spacing = 0;             ///< 0: a single plane
};

/// With spacing and count: count planes from the plane on. With spacing (above zero) alone: at all its
/// multiples from the plane, both ways, through the extent. With count alone: in the middles of as many equal
/// slices of the extent, so that areas times spacing is the midpoint rule for the volume. Throws limit
/// (E-SECTION) beyond a hundred thousand planes.
Stack stack_of(const Extent& extent, std::optional<double> spacing, std::optional<std::int64_t> count);

inline constexpr std::int64_t most_planes = 100000;

} // namespace facetmill
