#pragma once
// Drills holes through the wall of a hollow solid, so that its cavities can drain.

#include "mesh/mesh.hpp"

#include <optional>
#include <string>
#include <vector>

namespace facetmill {

struct DrainSettings {
    double diameter = 1;   ///< above zero, in world units
    std::size_t count = 1; ///< the maximum number of holes at the lowest points of each cavity
    bool vent = false;     ///< one more hole at the highest point of each cavity
    Vec3 up{0, 0, 1};      ///< of unit length, in world space
    int sides = 32;
    Transform to_world{}; ///< not singular
};

/// A hole. In world space.
struct DrainHole {
    Vec3 from, to; ///< the axis, from inside the cavity through the wall
    bool vent = false;
};

struct DrainResult {
    Mesh mesh;
    AttributeChanges changes;
    std::vector<DrainHole> holes;
    std::size_t cavities = 0, closed_cavities = 0; ///< all cavities, and cavities without a hole
    std::optional<std::string> failure;            ///< why the holes could not be cut; mesh is then unchanged
};

/// A cavity is a closed component whose faces face inward. A hole is a vertical cylinder. Its axis begins at
/// the lowest point at which a ball of its diameter fits into the cavity, and the cylinder passes through the
/// wall below. So the hole opens fully into the cavity, and nothing remains in the cavity below it. The
/// search tests points on the faces of the cavity, in steps of half the radius. Heights that differ by less
/// than an eighth of the diameter count as equal, and a single hole takes the middle of the lowest places.
/// Several holes are at least two diameters apart. A hole ends where all of its section has left the wall,
/// and before it meets the solid again; places where this is impossible are skipped. The result is closed and
/// manifold (see combine). The mesh must be a closed solid. The same for any number of threads.
[[nodiscard]] DrainResult drain(Mesh mesh, const DrainSettings& settings);

} // namespace facetmill
