#pragma once
// Histograms of edge lengths and face shapes of a scene, for pages.

#include "mesh/scene.hpp"

#include <cstdint>

namespace facetmill {

/// Counts of numbers between limits, with their range and mean. The limits are the same for all scenes, so
/// that histograms can be overlaid.
struct Histogram {
    std::vector<double> limits; ///< one more than bins
    std::vector<std::uint64_t>
        counts; ///< counts of bins; values outside the limits are in the first or last bin
    std::uint64_t total = 0;
    double minimum = 0, maximum = 0, mean = 0; ///< 0 without numbers
};

struct ShapeHistograms {
    Histogram edge_length;    ///< world lengths, each edge once for each of its faces; four bins per octave
    Histogram smallest_angle; ///< the smallest angle of each face, in degrees
    Histogram aspect_ratio;   ///< the aspect ratio of each face; for a polygon, the worst of its triangles
                              ///< (mesh/aspect_ratio.hpp)
    std::uint64_t flat_faces = 0; ///< faces without area, which have no aspect ratio
};

/// Histograms of all faces in world space, except faces that are not finite. The result does not depend on
/// the number of threads. O(n).
[[nodiscard]] ShapeHistograms shape_histograms(const Scene& scene);

/// Removes bins at the ends that are empty in both histograms, and merges neighbouring bins until at most
/// `most` are left. The histograms have the same limits. An empty histogram gets the limits of the other.
void trim(Histogram& a, Histogram& b, std::size_t most = 40);

} // namespace facetmill
