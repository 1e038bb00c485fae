#pragma once
// The distance between two surfaces in both directions, by samples and, on request, with a guaranteed upper
// bound. After P. Cignoni, C. Rocchini and R. Scopigno, "Metro: measuring error on simplified surfaces"
// (1998).

#include "geometry/spatial/face_tree.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace facetmill {

struct DeviationSettings {
    std::size_t samples = 100000; ///< samples in each direction, spread evenly over the area; in addition,
                                  ///< every vertex is a sample
    /// The means use 18ths of the samples, at least two, until the standard error of the RMS, relative to
    /// it, is at most this. The error is estimated from neighbouring samples. The maximum always uses all
    /// samples.
    double mean_error = 0.005;
    /// If false, rms, mean and averaged stay 0, and the maximum, which is the same, is found sooner.
    bool means = true;
    std::uint64_t seed = 1;
    bool certify = false; ///< also compute DirectedDeviation::bound
    /// The search for the bound stops near the larger maximum of both directions. The bound exceeds it by at
    /// most this fraction of the maximum, plus a millionth of the diagonal.
    double certify_to = 0.01;
    /// The limit of closest points that certify may look up in each direction. It limits work, not time, so
    /// that the result does not depend on the machine.
    std::size_t certify_work = 4000000;
};

/// The deviation from one surface to the other: the distance of each sample to the closest point of the
/// other surface. It is 0 within the rounding of coordinates (16 units of the last place).
struct DirectedDeviation {
    std::size_t samples = 0; ///< number of samples over the area
    std::size_t averaged =
        0; ///< the number of samples that rms and mean use; without samples, they use vertices
    std::size_t vertices =
        0; ///< vertices of triangles; if the surface has samples, vertices enter only the maximum
    /// The means use distances accurate to 1/256, or to 1/16384 of the maximum; most distances are accurate
    /// to a millionth.
    double maximum = 0, rms = 0, mean = 0;
    Vec3 from, to;     ///< the farthest sample and the point closest to it
    Index face = none; ///< a face of the surface measured from, at the farthest sample; none for a vertex
    /// No point of the surface is farther than this, up to the rounding of coordinates. At least `maximum`.
    /// If both directions are measured, the search stops after bounding the larger of the two maxima.
    std::optional<double> bound;
    std::size_t looked_up = 0; ///< closest points that certify looked up; they enter the maximum
};

/// The deviation in both directions, in the units of the surfaces. All numbers are infinite if one surface
/// is empty and the other is not.
struct DeviationResult {
    DirectedDeviation forward;  ///< from the first surface to the second
    DirectedDeviation backward; ///< from the second to the first
    double diagonal = 0;        ///< diagonal of the first surface's box, the basis of percentages
    std::uint64_t seed = 0;

    double maximum() const { return std::max(forward.maximum, backward.maximum); }
    double rms() const { return std::max(forward.rms, backward.rms); }
    double mean() const { return std::max(forward.mean, backward.mean); }
    /// The larger of both bounds, if both exist.
    std::optional<double> bound() const;
    /// The length in percent of the diagonal; 0 for 0, infinity if the diagonal is 0.
    double percent(double length) const;
};

/// Two-sided deviation. The samples depend only on the surface and the seed: the k-th is in the k-th of
/// equal parts of the area, taken face by face. The result does not depend on the number of threads.
/// Triangles with coordinates that are not finite are ignored. O((samples + vertices) log n).
[[nodiscard]] DeviationResult deviation(const Surface& first, const Surface& second,
                                        const DeviationSettings& settings = {});
/// The deviation in the meshes' own space, which must be the same for both.
[[nodiscard]] DeviationResult deviation(const Mesh& first, const Mesh& second,
                                        const DeviationSettings& settings = {});
/// The deviation in one direction, with a given tree. `bound` needs certify.
[[nodiscard]] DirectedDeviation deviation_to(const Surface& from, const FaceTree& to,
                                             const DeviationSettings& settings = {});

/// A point of a surface.
struct SurfaceSample {
    Vec3 point;
    Index triangle = none; ///< triangle of the surface
};
/// `count` points spread over the area as described above; empty if the surface has no area.
[[nodiscard]] std::vector<SurfaceSample> sample_area(const Surface& surface, std::size_t count,
                                                     std::uint64_t seed);

/// The distance below which rounded coordinates are indistinguishable (16 units in the last place). Samples
/// on triangles and their closest points are rounded.
[[nodiscard]] inline double distance_of_none(const Vec3& p) {
    return 16 * 2.220446049250313e-16 * std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
}
/// Replaces a distance below distance_of_none by 0, so that a surface has distance 0 from itself.
[[nodiscard]] inline double told_from_zero(double distance, const Vec3& p) {
    return distance <= distance_of_none(p) ? 0 : distance;
}

} // namespace facetmill
