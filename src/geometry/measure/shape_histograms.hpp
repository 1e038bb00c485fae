#pragma once
// How the edges and faces of a scene are shaped, as histograms for pages.

#include "mesh/scene.hpp"

#include <cstdint>

namespace facetmill {

/// Counts of numbers between limits, and their range and mean. The limits are the same for all scenes, so
/// that histograms can be shown one on the other.
struct Histogram {
    std::vector<double> limits;        ///< one more than bins
    std::vector<std::uint64_t> counts; ///< of bins; values outside are in the first or the last
    std::uint64_t total = 0;
    double minimum = 0, maximum = 0, mean = 0; ///< 0 for no numbers
};

struct ShapeHistograms {
    Histogram edge_length;        ///< in the world, each edge once for each of its faces; four bins an octave
    Histogram smallest_angle;     ///< of faces, in degrees
    Histogram aspect_ratio;       ///< of faces, the worst of a polygon's triangles (mesh/aspect_ratio.hpp)
    std::uint64_t flat_faces = 0; ///< without area: they have no aspect ratio
};

/// Of all faces in world space; what is not finite is left out. The same for any number of threads. O(n).
[[nodiscard]] ShapeHistograms shape_histograms(const Scene& scene);

/// Leaves out bins at the ends that are empty in both, and joins neighbours until at most `most` are left.
/// The histograms have the same limits. An empty histogram gets the limits of the other.
void trim(Histogram& a, Histogram& b, std::size_t most = 40);

} // namespace facetmill
