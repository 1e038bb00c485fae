#pragma once
// Lines, which have no surface until they get a thickness. A part has faces, or lines, or neither.

#include "mesh/scene.hpp"

#include <string>
#include <vector>

namespace facetmill {

/// Straight lines between points. Lines meet if they end at the same point, or at points with exactly the
/// same position.
struct Lines {
    struct Segment {
        Index from = 0, to = 0; ///< indices of points
        Index material = none;  ///< index in Scene::materials
    };

    std::string name;
    std::vector<Vec3> points; ///< in world space
    std::vector<Segment> segments;
};

/// The lines of the part in world space, under its name. O(n).
[[nodiscard]] Lines lines_of(const Part& part);

/// [vertices] 1 if a line of the mesh uses the vertex. O(n).
[[nodiscard]] std::vector<std::uint8_t> marked_ends_of_lines(const Mesh& mesh);

/// Separates the lines of a mesh that also has faces or points. Returns the lines, with their vertices and
/// attributes, without primitives. Vertices that only lines use are removed from the mesh. O(n).
[[nodiscard]] Mesh split_lines(Mesh& mesh);

} // namespace facetmill
