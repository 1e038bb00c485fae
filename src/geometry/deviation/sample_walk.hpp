#pragma once
// Measures the distances of a surface's samples and vertices to another surface. Triangles are visited so
// that each is near the previous, and neighbours are measured together.

#include "geometry/deviation/area_samples.hpp"
#include "geometry/spatial/closest_point.hpp"

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace facetmill {

/// The samples of a surface, and their distances to another surface if already measured.
struct MeasuredSamples {
    static constexpr std::size_t all_parts = 18; ///< the number of parts in which samples are measured
    static constexpr double unmeasured = -1;
    /// A distance below this multiple of its error is computed again exactly, unless the error is below this
    /// part of the farthest distance so far.
    static constexpr double most_errors = 256, least_part = 1.0 / 16384;

    /// order: the triangles, each near the previous.
    MeasuredSamples(const Surface& surface, std::span<const Index> order, std::size_t count,
                    std::uint64_t seed)
        : points(surface, count, seed), runs(points.runs(order)), distances(points.size(), unmeasured),
          nearest(points.size(), none) {}

    /// Calls call(i) for the samples in [begin, end) of parts [first, last), in their order. A part is
    /// spread evenly over all samples, and so are several parts, approximately.
    template <class Call>
    static void each_of(std::size_t first, std::size_t last, std::size_t begin, std::size_t end,
                        const Call& call) {
        if (begin == end) return;
        const std::uint32_t wanted = row_before(last) & ~row_before(first);
        std::size_t row = begin - begin % all_parts;
        for (std::uint32_t left = wanted & ~std::uint32_t{0} << (begin - row); row < end;
             row += all_parts, left = wanted)
            for (; left != 0; left &= left - 1) {
                const std::size_t i = row + static_cast<std::size_t>(std::countr_zero(left));
                if (i >= end) return;
                call(i);
            }
    }

    std::size_t chunk() const; ///< the number of runs that a thread takes at a time

    AreaSamples points;
    std::vector<AreaSamples::Run> runs; ///< runs in the order of the walk
    std::size_t parts = 0;              ///< the parts before this are measured
    std::vector<double> distances;      ///< [samples] measured distances
    std::vector<Index> nearest; ///< [samples] for measured samples, a triangle of the other surface's tree

  private:
    /// For the first sample of each part: bit i is set if the i-th sample belongs to an earlier part.
    static std::uint32_t row_before(std::size_t part);
};

/// A point and its closest point.
struct Farthest {
    Vec3 from, to;
    double distance = -1;
    Index triangle = none; ///< the triangle of the sample; none for a vertex
};
[[nodiscard]] inline Farthest farther_of(const Farthest& a, const Farthest& b) {
    return b.distance > a.distance ? b : a;
}

class SampleWalk {
  public:
    /// order: the triangles, each near the previous.
    SampleWalk(const Surface& from, std::span<const Index> order, const FaceTree& to);

    /// The number of finite vertices of triangles.
    std::size_t vertex_count() const;
    std::vector<Vec3> vertices() const;

    /// Measures the first `parts` parts of the samples, except those already measured. Returns the farthest
    /// sample if it is beyond `least`.
    Farthest measure(MeasuredSamples& samples, std::size_t parts, double least) const;

    // The following searches stop early for points that are nearer than the farthest so far.

    /// The farthest vertex, if beyond `least`. near: output, [vertices] a triangle of the other surface's
    /// tree near each vertex, or none.
    Farthest farthest_vertex(double least, std::vector<Index>& near) const;
    /// The farthest unmeasured sample, if beyond `least`. near: the result of farthest_vertex, tried first
    /// if a triangle has few samples; or empty.
    Farthest farthest_sample(const MeasuredSamples& samples, double least,
                             std::span<const Index> near = {}) const;

  private:
    class Known;
    struct Candidates;
    struct Groups;
    template <class Add>
    Farthest farthest(std::size_t count, double least, std::size_t chunk, const Add& add) const;
    Closest consider(const Vec3& p, Index triangle, Index hint, Farthest& best) const;

    const Surface& from_;
    std::span<const Index> order_;
    const FaceTree& to_;
    std::vector<Index> first_uses_;
};

} // namespace facetmill
