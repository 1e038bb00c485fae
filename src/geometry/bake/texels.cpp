#include "geometry/bake/texels.hpp"

#include "parallel/parallel.hpp"

#include <atomic>

namespace facetmill::baking {

namespace {

std::int64_t fixed(double texels) { return static_cast<std::int64_t>(std::floor(texels * texel_unit + 0.5)); }

/// Floor and ceiling of a fixed number in texels.
int floor_texel(std::int64_t x) { return static_cast<int>(x >> 16); }

std::int64_t turn(const FixedPoint& a, const FixedPoint& b, const FixedPoint& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Of two triangles at an edge, exactly one owns a point on it.
bool owns_edge(const FixedPoint& a, const FixedPoint& b) { return a.y != b.y ? b.y < a.y : b.x > a.x; }

void mark(std::vector<std::uint8_t>& marks, Index triangle, std::uint8_t bit) {
    const std::atomic_ref<std::uint8_t> slot(marks[triangle]);
    if ((slot.load(std::memory_order_relaxed) & bit) == 0) slot.fetch_or(bit, std::memory_order_relaxed);
}

struct Rectangle {
    int left, right, top, bottom; ///< inclusive
};

Rectangle around(const std::array<FixedPoint, 3>& p, int grow) {
    const auto [x0, x1] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [y0, y1] = std::minmax({p[0].y, p[1].y, p[2].y});
    return {floor_texel(x0) - grow, floor_texel(x1) + grow, floor_texel(y0) - grow, floor_texel(y1) + grow};
}

/// The weights of the point of a segment nearest to p, and the squared distance.
double nearest_on_segment(const std::array<double, 6>& c, std::size_t a, std::size_t b, double x, double y,
                          Vec3& weights) {
    const double dx = c[2 * b] - c[2 * a], dy = c[2 * b + 1] - c[2 * a + 1];
    const double px = x - c[2 * a], py = y - c[2 * a + 1];
    const double square = dx * dx + dy * dy;
    const double t = square > 0 ? std::clamp((px * dx + py * dy) / square, 0.0, 1.0) : 0;
    weights = {};
    weights[a] = 1 - t;
    weights[b] += t;
    const double ex = px - t * dx, ey = py - t * dy;
    return ex * ex + ey * ey;
}

} // namespace

/// The samples of a band, and for texels without one the distance of the nearest triangle.
struct TexelBands::Samples {
    int top = 0, row_count = 0, width = 0, per_side = 1;
    std::vector<TexelPlace> places;
    std::vector<std::uint8_t> covered; ///< [texels] whether a sample is covered
    std::vector<double> distances;     ///< [texels] squared distance of the nearest triangle

    std::size_t texel(int x, int y) const {
        return static_cast<std::size_t>(y - top) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
    TexelPlace& at(int x, int y, int i, int j) {
        const auto n = static_cast<std::size_t>(per_side);
        return places[texel(x, y) * n * n + static_cast<std::size_t>(j) * n + static_cast<std::size_t>(i)];
    }
    Rectangle within(const Rectangle& r) const {
        return {std::max(r.left, 0), std::min(r.right, width - 1), std::max(r.top, top),
                std::min(r.bottom, top + row_count - 1)};
    }
};

TexelBands::TexelBands(const Mesh& mesh, int size, int samples) : size_(size), samples_(samples) {
    const Attribute& uv = *mesh.find("TEXCOORD_0", Domain::wedge);
    points_.resize(mesh.corner_count());
    parallel_for(points_.size(), [&](std::size_t c) {
        const Index w = mesh.corners[c];
        points_[c] = {fixed(uv.value(w, 0) * size), fixed(uv.value(w, 1) * size)};
    });
    const std::size_t bands = static_cast<std::size_t>((size + rows - 1) / rows);
    const auto range = [&](std::size_t t) {
        const Rectangle r = around({points_[3 * t], points_[3 * t + 1], points_[3 * t + 2]}, 1);
        return std::pair(std::clamp(r.top, 0, size_ - 1) / rows, std::clamp(r.bottom, 0, size_ - 1) / rows);
    };
    begin_.assign(bands + 1, 0);
    for (std::size_t t = 0; t < mesh.face_count(); ++t) {
        const auto [first, last] = range(t);
        for (int b = first; b <= last; ++b) ++begin_[static_cast<std::size_t>(b)];
    }
    triangles_.resize(exclusive_scan(begin_));
    std::vector<std::size_t> at = begin_;
    for (std::size_t t = 0; t < mesh.face_count(); ++t) {
        const auto [first, last] = range(t);
        for (int b = first; b <= last; ++b)
            triangles_[at[static_cast<std::size_t>(b)]++] = static_cast<Index>(t);
    }
}

std::array<double, 6> TexelBands::corners(Index triangle) const {
    std::array<double, 6> all{};
    for (std::size_t k = 0; k < 3; ++k) {
        const FixedPoint& p = points_[3 * std::size_t{triangle} + k];
        all[2 * k] = static_cast<double>(p.x) / texel_unit;
        all[2 * k + 1] = static_cast<double>(p.y) / texel_unit;
    }
    return all;
}

void TexelBands::cover(Samples& samples, Index triangle, std::vector<std::uint8_t>& marks) const {
    std::array<FixedPoint, 3> p = {points_[3 * std::size_t{triangle}], points_[3 * std::size_t{triangle} + 1],
                                   points_[3 * std::size_t{triangle} + 2]};
    const std::int64_t area = turn(p[0], p[1], p[2]);
    if (area == 0) return;
    const bool mirrored = area < 0;
    if (mirrored) std::swap(p[1], p[2]);
    std::array<std::int64_t, 3> least{}; // the smallest value of each edge that is inside
    for (std::size_t k = 0; k < 3; ++k) least[k] = owns_edge(p[(k + 1) % 3], p[(k + 2) % 3]) ? 0 : 1;
    const double whole = static_cast<double>(mirrored ? -area : area);
    const Rectangle r = samples.within(around(p, 0));
    const int n = samples_;
    for (int y = r.top; y <= r.bottom; ++y)
        for (int x = r.left; x <= r.right; ++x)
            for (int s = 0; s < n * n; ++s) {
                const int i = s % n, j = s / n;
                const FixedPoint at = {x * texel_unit + texel_unit * (2 * i + 1) / (2 * n),
                                       y * texel_unit + texel_unit * (2 * j + 1) / (2 * n)};
                const std::int64_t a = turn(p[1], p[2], at), b = turn(p[2], p[0], at),
                                   c = turn(p[0], p[1], at);
                if (a < least[0] || b < least[1] || c < least[2]) continue;
                TexelPlace& place = samples.at(x, y, i, j);
                if (place.triangle != none) {
                    mark(marks, triangle, 3);
                    mark(marks, place.triangle, 2);
                    continue;
                }
                mark(marks, triangle, 1);
                Vec3 w = {static_cast<double>(a) / whole, static_cast<double>(b) / whole,
                          static_cast<double>(c) / whole};
                if (mirrored) std::swap(w.y, w.z);
                place = {triangle, w};
                samples.covered[samples.texel(x, y)] = 1;
            }
}

void TexelBands::border(Samples& samples, Index triangle) const {
    const std::array<double, 6> c = corners(triangle);
    const Rectangle r =
        samples.within(around({points_[3 * std::size_t{triangle}], points_[3 * std::size_t{triangle} + 1],
                               points_[3 * std::size_t{triangle} + 2]},
                              1));
    for (int y = r.top; y <= r.bottom; ++y)
        for (int x = r.left; x <= r.right; ++x) {
            const std::size_t texel = samples.texel(x, y);
            if (samples.covered[texel]) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                Vec3 weights;
                const double d = nearest_on_segment(c, k, (k + 1) % 3, x + 0.5, y + 0.5, weights);
                if (d >= samples.distances[texel]) continue;
                samples.distances[texel] = d;
                samples.at(x, y, 0, 0) = {triangle, weights};
            }
        }
}

std::vector<TexelPlace> TexelBands::places(std::size_t band, std::vector<std::uint8_t>& marks) const {
    Samples samples;
    samples.top = first_row(band);
    samples.row_count = row_count(band);
    samples.width = size_;
    samples.per_side = samples_;
    const std::size_t texels = static_cast<std::size_t>(samples.row_count) * static_cast<std::size_t>(size_);
    samples.places.resize(texels * static_cast<std::size_t>(samples_ * samples_));
    samples.covered.resize(texels);
    samples.distances.assign(texels, 1);
    for (std::size_t i = begin_[band]; i < begin_[band + 1]; ++i) cover(samples, triangles_[i], marks);
    for (std::size_t i = begin_[band]; i < begin_[band + 1]; ++i) border(samples, triangles_[i]);
    return std::move(samples.places);
}

} // namespace facetmill::baking
