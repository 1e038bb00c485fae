#pragma once
// The signed distance of a scene from a surface, which pages show as colours.

#include "geometry/spatial/face_tree.hpp"
#include "mesh/scene.hpp"

#include <optional>
#include <string_view>

namespace facetmill {

/// The vertex attribute of SignedDeviation::scene.
inline constexpr std::string_view distance_attribute = "distance";

struct SignedDeviationSettings {
    /// The number of vertices to look up. If the scene has more, one vertex represents its cell of a grid.
    /// Near the farthest of these vertices, all vertices are looked up.
    std::size_t vertices = 20000;
    std::size_t samples = 10000; ///< points spread over the area
    std::uint64_t seed = 1;
    /// The largest cap number of the reference (last_cap). Faces that close later cuts are not measured,
    /// because the reference has no surface there. None: all faces are measured.
    std::optional<Index> last_cap = {};
};

/// Cuts triangles with edges longer than a 64th of the diagonal, so that vertex colours show their inside,
/// while few points are added. Returns whether any triangle was cut. A cut part has only triangles, no
/// seams, and only face attributes. O(n).
bool cut_large_faces(Scene& scene, double diagonal);

/// The largest cap number in a scene, by the face attribute cut_id; 0 without caps.
[[nodiscard]] Index last_cap(const Scene& scene);

/// Distances are positive outside: on the side that the nearest face of the reference faces.
struct SignedDeviation {
    /// Only the faces, with a distance at each vertex (0 if it is not finite). Large faces are cut into
    /// small faces, so that the colours show their inside.
    Scene scene;
    bool is_cut = false;  ///< some faces were cut
    std::size_t caps = 0; ///< unmeasured faces, as separate parts at the end without distances
    std::vector<float>
        samples; ///< distances of points spread over the area, or of vertices if the scene has no area
    std::size_t looked_up = 0; ///< total number of points
    double low = 0, high = 0;  ///< the smallest and the largest distance that was seen
    double mean = 0, rms = 0;  ///< mean and RMS of the samples' absolute values
    Vec3 worst;                ///< the vertex or sample that is farthest, in the world
    double worst_distance = 0;
    Vec3 worst_normal; ///< normal of the faces at `worst`, not of unit length; zero without faces
    bool any() const { return looked_up > 0; }
};

/// Measures from the scene, in world space, to the reference, so parts of the reference missing in the scene
/// have no effect. Empty if the reference or the scene is empty. The result does not depend on the number of
/// threads. O((vertices + samples) log n).
[[nodiscard]] SignedDeviation signed_deviation(const Scene& scene, const FaceTree& reference,
                                               const SignedDeviationSettings& settings = {});

} // namespace facetmill
