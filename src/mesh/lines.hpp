#pragma once
// Lines of a file, which are no surface until they get a thickness.

#include "mesh/mesh.hpp"

#include <string>
#include <vector>

namespace facetmill {

/// Straight lines between points. Lines that end at one point, or at points of exactly the same place, meet
/// there.
struct Lines {
    struct Segment {
        Index from = 0, to = 0; ///< into points
        Index material = none;  ///< into Scene::materials
    };

    std::string name;
    std::vector<Vec3> points; ///< in world space
    std::vector<Segment> segments;
};

} // namespace facetmill
