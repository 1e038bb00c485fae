#include "geometry/measure/shape_histograms.hpp"

#include "base/parallel.hpp"
#include "base/portable_math.hpp"
#include "mesh/aspect_ratio.hpp"
#include "mesh/face.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill {

namespace {

constexpr std::size_t shape_chunk = 65536; // faces; each has counts of its own

/// Numbers into bins; chunks are joined in order, so that sums do not depend on threads.
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

// Powers of two and quarters of them.
constexpr int lowest_octave = -150, octaves = 300;
constexpr double quarters[4] = {1, 1.189207115002721, 1.4142135623730951, 1.681792830507429};

std::vector<double> powers(int first_octave, std::size_t bins) {
    std::vector<double> limits(bins + 1);
    for (std::size_t i = 0; i <= bins; ++i)
        limits[i] = std::ldexp(quarters[i % 4], first_octave + static_cast<int>(i / 4));
    return limits;
}

/// The bin among those that begin at the octave, four to an octave; what is below is in the first.
std::size_t power_bin(double x, int first_octave) {
    int exponent = 0;
    const double mantissa = 2 * std::frexp(x, &exponent); // 1 to 2
    const int octave = exponent - 1 - first_octave;
    if (!(x > 0) || octave < 0) return 0;
    const auto quarter = static_cast<std::size_t>(
        std::upper_bound(std::begin(quarters), std::end(quarters), mantissa) - std::begin(quarters) - 1);
    return 4 * static_cast<std::size_t>(octave) + quarter;
}

constexpr double angle_bin = 2.5; // degrees
constexpr std::size_t angle_bins = 72, aspect_bins = 24;

struct Shapes {
    Counted edges{4 * octaves}, angles{angle_bins}, aspects{aspect_bins};
    std::uint64_t flat = 0;
    void add(const Shapes& other) {
        edges.add(other.edges);
        angles.add(other.angles);
        aspects.add(other.aspects);
        flat += other.flat;
    }
};

double cosine_at(const Vec3& at, const Vec3& b, const Vec3& c) {
    const Vec3 u = b - at, v = c - at;
    const double lengths = std::sqrt(dot(u, u) * dot(v, v));
    return lengths > 0 ? std::clamp(dot(u, v) / lengths, -1.0, 1.0)
                       : 1; // a corner without sides has no angle
}

class ShapesOfFaces {
  public:
    explicit ShapesOfFaces(const Part& part) : mesh_(part.mesh), to_world_(part.transform) {}

    Shapes operator()(std::size_t begin, std::size_t end) const {
        Shapes out;
        for (std::size_t f = begin; f < end; ++f) add(static_cast<Index>(f), out);
        return out;
    }

  private:
    Vec3 point(Index corner) const { return to_world_.point(mesh_.point(corner)); }

    void add(Index f, Shapes& out) const {
        const Index first = mesh_.face_begin(f), end = mesh_.face_end(f);
        for (Index c = first; c < end; ++c)
            if (!is_finite(point(c))) return;
        double sharpest = -1, worst = 0; // cosine, aspect ratio
        for (Index c = first; c < end; ++c) {
            const Vec3 p = point(c), next = point(next_corner(c, first, end));
            const double edge = length(next - p);
            out.edges.add(power_bin(edge, lowest_octave), edge);
            sharpest = std::max(sharpest, cosine_at(p, point(previous_corner(c, first, end)), next));
            if (c > first && c + 1 < end) worst = std::max(worst, aspect_ratio(point(first), p, next));
        }
        const double angle = arc_cosine(sharpest) * 180 / pi;
        out.angles.add(static_cast<std::size_t>(angle / angle_bin), angle);
        if (std::isfinite(worst))
            out.aspects.add(power_bin(worst, 0), worst);
        else
            ++out.flat;
    }

    const Mesh& mesh_;
    const Transform& to_world_;
};

/// The bins from `begin` to `end`, `together` of them in one.
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
    return {all.edges.histogram(powers(lowest_octave, 4 * octaves)), all.angles.histogram(std::move(degrees)),
            all.aspects.histogram(powers(0, aspect_bins)), all.flat};
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
