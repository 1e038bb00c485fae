#pragma once
// On which side of a surface a scene lies, and how far off: what pages show as colours.

#include "geometry/spatial/face_tree.hpp"
#include "mesh/scene.hpp"

#include <optional>
#include <string_view>

namespace facetmill {

/// The vertex attribute of SignedDeviation::scene.
inline constexpr std::string_view distance_attribute = "distance";

struct SignedDeviationSettings {
    /// Vertices that are looked up. Where there are more, one stands for those in its cell of a grid, but
    /// around the farthest of these all are looked up.
    std::size_t vertices = 20000;
    std::size_t samples = 10000; ///< points spread over the area
    std::uint64_t seed = 1;
    /// The largest number of a cap that the reference has (last_cap): faces that close later cuts are not
    /// measured, since the reference has no surface there. None: all faces are.
    std::optional<Index> last_cap = {};
};

/// Cuts the triangles of all parts where their edges are longer than a 64th of the diagonal, so that colours
/// of vertices show what happens inside, as long as few points are added. Whether any was cut; then its part
/// has triangles alone, no seams, and of its attributes those of faces. O(n).
bool cut_large_faces(Scene& scene, double diagonal);

/// The largest number of a cap in a scene: of the face attribute cut_id, 0 where nothing was capped.
Index last_cap(const Scene& scene);

/// Distances are positive outside: on the side that the nearest face of the reference looks to.
struct SignedDeviation {
    /// The faces alone, each vertex with its distance (0 where it is not finite). Large faces are
    /// cut into small ones, so that what happens inside them is seen.
    Scene scene;
    bool is_cut = false;        ///< some are
    std::size_t caps = 0;       ///< faces that were not measured: parts of their own, last, without distances
    std::vector<float> samples; ///< distances of points spread over the area; of vertices where there is none
    std::size_t looked_up = 0;  ///< points in all
    double low = 0, high = 0;   ///< the smallest and the largest distance that was seen
    double mean = 0, rms = 0;   ///< of the amounts of the samples
    Vec3 worst;                 ///< the vertex or sample that is farthest, in the world
    double worst_distance = 0;
    Vec3 worst_normal; ///< of the faces there, not of unit length; zero where there are none
    bool any() const { return looked_up > 0; }
};

/// From the scene, in world space, to the reference: what the reference has and the scene has not does not
/// show. Nothing when the reference is empty, or the scene. The same for any number of threads.
/// O((vertices + samples) log n).
SignedDeviation signed_deviation(const Scene& scene, const FaceTree& reference,
                                 const SignedDeviationSettings& settings = {});

} // namespace facetmill
