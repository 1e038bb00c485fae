#pragma once
// Finds faces that no ray from outside reaches.

#include "geometry/spatial/face_tree.hpp"

#include <cstdint>
#include <vector>

namespace facetmill {

struct HiddenSettings {
    double gap = 0;              ///< openings wider than this count as open; above 0
    std::size_t directions = 64; ///< of the rays from each face
};

struct HiddenFaces {
    std::vector<std::uint8_t> flags; ///< [faces] 1: hidden
    std::size_t outer_rays = 0;      ///< rays from outside
    std::size_t face_rays = 0;       ///< rays from faces
};

/// Rays from outside: in 14 directions, a grid of parallel rays with a spacing of gap / sqrt(2). An opening
/// that shows a disc of diameter gap in one of these directions lets at least one ray through. The first face
/// of each ray is reached. Then rays leave each other face from its centre and three points near its corners,
/// in evenly spread directions; a face with a ray that meets nothing is reached. Both sides of a face count.
/// Faces nearer to the start of a ray than a millionth of the diagonal do not stop it, so that coincident
/// faces do not hide each other.
///
/// A face that shares a vertex with a reached face is kept, too. tree: over the surface. faces: the number of
/// faces that it numbers. Throws a limit error (E-LIMIT) with the number if the grid has more than 10^8 rays.
/// Parallel; the result does not depend on the number of threads.
[[nodiscard]] HiddenFaces hidden_faces(const Surface& surface, const FaceTree& tree, std::size_t faces,
                                       const HiddenSettings& settings);

/// The number of rays from outside.
[[nodiscard]] double outer_ray_count(const Box& box, double gap);

} // namespace facetmill
