#include "geometry/measure/shape_histograms.hpp"

#include "base/math/arc_tangents.hpp"
#include "base/math/portable_math.hpp"
#include "base/math/simd.hpp"
#include "base/math/whole_number.hpp"
#include "mesh/aspect_ratio.hpp"
#include "mesh/face.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace facetmill {

namespace {

constexpr std::size_t shape_chunk = 65536; // faces per chunk; each chunk has separate counts

/// Counts numbers in bins. Chunks are joined in order, so that sums do not depend on threads.
struct Counted {
    std::vector<std::uint64_t> counts;
    std::uint64_t total = 0;
    double minimum = HUGE_VAL, maximum = 0, sum = 0;

    explicit Counted(std::size_t bins = 0) : counts(bins) {}
    void add(std::size_t bin, double value) {
        ++counts[std::min(bin, counts.size() - 1)];
        ++total;
        minimum = std::min(minimum, value);
        maximum = std::max(maximum, value);
        sum += value;
    }
    void add(const Counted& other) {
        for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += other.counts[i];
        total += other.total;
        minimum = std::min(minimum, other.minimum);
        maximum = std::max(maximum, other.maximum);
        sum += other.sum;
    }
    Histogram histogram(std::vector<double> limits) const {
        if (total == 0) return {std::move(limits), counts, 0, 0, 0, 0};
        return {std::move(limits), counts, total, minimum, maximum, sum / static_cast<double>(total)};
    }
};

// The bins cover powers of two, each divided into four.
constexpr int lowest_octave = -150, octaves = 300;
constexpr double quarters[4] = {1, 1.189207115002721, 1.4142135623730951, 1.681792830507429};

std::vector<double> powers(int first_octave, std::size_t bins) {
    std::vector<double> limits(bins + 1);
    for (std::size_t i = 0; i <= bins; ++i)
        limits[i] = std::ldexp(quarters[i % 4], first_octave + static_cast<int>(i / 4));
    return limits;
}

/// The bin of x, with four bins to an octave, from first_octave on. Smaller values go into the first bin.
std::size_t power_bin(double x, int first_octave) {
    if (!(x > 0)) return 0;
    constexpr int mantissa_bits = 52, bias = 1023;
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const int octave = static_cast<int>(bits >> mantissa_bits) - bias - first_octave;
    if (octave < 0) return 0;
    const std::uint64_t below_two = bits & ((std::uint64_t{1} << mantissa_bits) - 1);
    const double mantissa =
        std::bit_cast<double>(below_two | std::uint64_t{bias} << mantissa_bits); // a number from 1 to 2
    const int quarter = (mantissa >= quarters[1]) + (mantissa >= quarters[2]) + (mantissa >= quarters[3]);
    return static_cast<std::size_t>(4 * octave + quarter);
}

constexpr double angle_bin = 2.5; // bin width in degrees
constexpr std::size_t angle_bins = 72, aspect_bins = 24;

struct Shapes {
    /// Separate counts of the first, second and third edges of faces. Neighbours often fall into the same
    /// bin, so with a single count each addition would wait for the previous one.
    std::array<Counted, 3> edges{Counted(4 * octaves), Counted(4 * octaves), Counted(4 * octaves)};
    Counted angles{angle_bins}, aspects{aspect_bins};
    std::uint64_t flat = 0;

    void add_edge(std::size_t i, double length) {
        edges[i % 3].add(power_bin(length, lowest_octave), length);
    }
    Counted all_edges() const {
        Counted all = edges[0];
        all.add(edges[1]);
        all.add(edges[2]);
        return all;
    }
    void add(const Shapes& other) {
        for (std::size_t i = 0; i < edges.size(); ++i) edges[i].add(other.edges[i]);
        angles.add(other.angles);
        aspects.add(other.aspects);
        flat += other.flat;
    }
};

/// The cosine of the angle between an edge and the next edge, at their common corner.
double cosine_between(const Vec3& edge, double its_length, const Vec3& next, double next_length) {
    const double lengths = its_length * next_length;
    return lengths > 0 ? std::clamp(-dot(edge, next) / lengths, -1.0, 1.0)
                       : 1; // a corner with an edge of length 0 has no angle
}

/// smallest: the smallest angle. worst: the largest aspect ratio.
void add_shape(double smallest, double worst, Shapes& out) {
    const double angle = smallest * 180 / pi;
    out.angles.add(whole_number<std::size_t>(angle / angle_bin), angle);
    if (std::isfinite(worst))
        out.aspects.add(power_bin(worst, 0), worst);
    else
        ++out.flat;
}

/// A batch of consecutive triangles. Data is gathered first, then angles are computed, then everything is
/// counted in order. So no step waits for a branch of another step.
class TriangleBatch {
  public:
    bool is_full() const { return count_ == most; }

    void add(const Vec3& a, const Vec3& b, const Vec3& c) {
        const std::array<Vec3, 3> sides{b - a, c - b, a - c};
        const std::array<double, 3> lengths{length(sides[0]), length(sides[1]), length(sides[2])};
        const double twice = length(cross(sides[0], sides[2])); // twice the area
        const std::array<double, 3> along{-dot(sides[1], sides[2]), -dot(sides[2], sides[0]),
                                          -dot(sides[0], sides[1])};
        // The smallest angle is opposite the shortest edge.
        const auto [x, y, z] = lengths;
        const bool is_x = static_cast<int>(x <= y) &
                          static_cast<int>(x <= z); // avoids branches, because no outcome is likelier
        const std::size_t shortest = static_cast<std::size_t>(!is_x) * (y <= z ? 1U : 2U);
        const std::size_t i = count_++;
        for (std::size_t k = 0; k < 3; ++k) edges_[3 * i + k] = lengths[k];
        aspects_[i] = aspect_ratio(x, y, z, twice / 2);
        y_[i] = twice;
        x_[i] = along[shortest];
        if (twice > 1e-140 && twice < 1e140) return; // the area gives the angle without another square root
        // For triangles that are flat, or whose lengths' fourth powers overflow. If squares of lengths also
        // overflow, the cosine is -1.
        const std::size_t first = (shortest + 1) % 3, second = (shortest + 2) % 3;
        odd_.emplace_back(i, arc_cosine(std::max(-1.0, cosine_between(sides[first], lengths[first],
                                                                      sides[second], lengths[second]))));
        y_[i] = x_[i] = 1;
    }

    void count(Shapes& out) {
        arc_tangents(std::span(y_).first(count_), std::span(x_).first(count_), std::span(y_).first(count_));
        for (const auto& [i, angle] : odd_) y_[i] = angle;
        for (std::size_t i = 0; i < 3 * count_; i += 3)
            for (std::size_t k = 0; k < 3; ++k) out.add_edge(k, edges_[i + k]);
        for (std::size_t i = 0; i < count_; ++i) add_shape(y_[i], aspects_[i], out);
        count_ = 0;
        odd_.clear();
    }

  private:
    static constexpr std::size_t most = 128;

    std::size_t count_ = 0;
    std::array<double, 3 * most> edges_;
    std::array<double, most> y_, x_, aspects_;        ///< y_ and x_ give the smallest angle
    std::vector<std::pair<std::size_t, double>> odd_; ///< triangles whose angles are computed separately
};

class ShapesOfFaces {
  public:
    explicit ShapesOfFaces(const Part& part)
        : mesh_(part.mesh), to_world_(part.transform), is_moved_(!part.transform.identity()) {}

    Shapes operator()(std::size_t begin, std::size_t end) const {
        Shapes out;
        Outline outline;
        TriangleBatch triangles;
        const auto corners = static_cast<Index>(mesh_.corner_count());
        for (auto f = static_cast<Index>(begin); f < end; ++f) {
            constexpr Index ahead = 24;
            if (f + ahead < end) { // prefetches only the first points of a large face
                const Index first = mesh_.face_begin(f + ahead);
                for (Index c = first; c < std::min(first + 3, corners); ++c) fetch_soon(mesh_.point(c));
            }
            const bool is_triangle = mesh_.face_size(f) == 3;
            if (triangles.is_full() || !is_triangle) triangles.count(out);
            if (is_triangle)
                add_triangle(f, triangles);
            else
                add(f, outline, out);
        }
        triangles.count(out);
        return out;
    }

  private:
    /// Like add, without arrays of unknown size, because most faces are triangles.
    void add_triangle(Index f, TriangleBatch& triangles) const {
        const Index first = mesh_.face_begin(f);
        const Vec3 a = point(first), b = point(first + 1), c = point(first + 2);
        if (is_finite(a) && is_finite(b) && is_finite(c)) triangles.add(a, b, c);
    }
    Vec3 point(Index corner) const {
        const Vec3& p = mesh_.point(corner);
        return is_moved_ ? to_world_.point(p) : p;
    }

    /// A face in the world: its points, the edge from each point to the next, and the lengths of the edges.
    struct Outline {
        std::vector<Vec3> points, edges;
        std::vector<double> lengths;
    };

    /// Fills the outline of a face. False if a point is not finite.
    bool follow(Index f, Outline& outline) const {
        const Index first = mesh_.face_begin(f);
        const std::size_t n = mesh_.face_end(f) - first;
        outline.points.resize(n);
        outline.edges.resize(n);
        outline.lengths.resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            outline.points[i] = point(first + static_cast<Index>(i));
            if (!is_finite(outline.points[i])) return false;
        }
        for (std::size_t i = 0; i < n; ++i) {
            outline.edges[i] = outline.points[i + 1 < n ? i + 1 : 0] - outline.points[i];
            outline.lengths[i] = length(outline.edges[i]);
        }
        return true;
    }

    /// The largest aspect ratio of the triangles of the fan from the first corner.
    static double worst_aspect(const Outline& o) {
        double worst = 0;
        for (std::size_t i = 1; i + 1 < o.points.size(); ++i)
            worst = std::max(worst, aspect_ratio(o.points[0], o.points[i], o.points[i + 1]));
        return worst;
    }

    void add(Index f, Outline& outline, Shapes& out) const {
        if (!follow(f, outline)) return;
        const std::size_t n = outline.points.size();
        double sharpest = -1; // cosine of the smallest angle so far
        for (std::size_t i = 0; i < n; ++i) {
            out.add_edge(i, outline.lengths[i]);
            const std::size_t next = i + 1 < n ? i + 1 : 0;
            sharpest = std::max(sharpest, cosine_between(outline.edges[i], outline.lengths[i],
                                                         outline.edges[next], outline.lengths[next]));
        }
        add_shape(arc_cosine(sharpest), worst_aspect(outline), out);
    }

    const Mesh& mesh_;
    const Transform& to_world_;
    bool is_moved_;
};

/// The bins from `begin` to `end`, each group of `together` bins merged.
void rebin(Histogram& h, std::size_t begin, std::size_t end, std::size_t together) {
    Histogram out = h;
    out.limits = {h.limits[begin]};
    out.counts.clear();
    for (std::size_t i = begin; i < end; i += together) {
        const std::size_t stop = std::min(i + together, end);
        std::uint64_t sum = 0;
        for (std::size_t k = i; k < stop; ++k) sum += h.counts[k];
        out.counts.push_back(sum);
        out.limits.push_back(h.limits[stop]);
    }
    h = std::move(out);
}

} // namespace

ShapeHistograms shape_histograms(const Scene& scene) {
    Shapes all;
    for (const Part& part : scene.parts) {
        const Shapes shapes = parallel_reduce(
            part.mesh.face_count(), Shapes{}, ShapesOfFaces(part),
            [](Shapes a, const Shapes& b) {
                a.add(b);
                return a;
            },
            shape_chunk);
        all.add(shapes);
    }
    std::vector<double> degrees(angle_bins + 1);
    for (std::size_t i = 0; i < degrees.size(); ++i) degrees[i] = angle_bin * static_cast<double>(i);
    return {all.all_edges().histogram(powers(lowest_octave, 4 * octaves)),
            all.angles.histogram(std::move(degrees)), all.aspects.histogram(powers(0, aspect_bins)),
            all.flat};
}

void trim(Histogram& a, Histogram& b, std::size_t most) {
    if (a.counts.empty()) a = {b.limits, std::vector<std::uint64_t>(b.counts.size())};
    if (b.counts.empty()) b = {a.limits, std::vector<std::uint64_t>(a.counts.size())};
    const auto used = [&](std::size_t i) { return a.counts[i] + b.counts[i] > 0; };
    std::size_t begin = 0, end = a.counts.size();
    while (begin + 1 < end && !used(begin)) ++begin;
    while (end > begin + 1 && !used(end - 1)) --end;
    std::size_t together = 1;
    while ((end - begin + together - 1) / together > most) together *= 2;
    if (a.counts.empty()) return;
    rebin(a, begin, end, together);
    rebin(b, begin, end, together);
}

} // namespace facetmill
