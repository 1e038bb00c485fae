#include "geometry/remesh/sizing.hpp"

#include "base/math/angle.hpp"
#include "parallel/parallel.hpp"

#include <queue>

namespace facetmill::remeshing {

namespace {

/// A symmetric tensor, summed over the edges at a vertex.
struct CurvatureSum {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, area = 0;

    void add(const Vec3& unit, double weight) {
        xx += weight * unit.x * unit.x;
        xy += weight * unit.x * unit.y;
        xz += weight * unit.x * unit.z;
        yy += weight * unit.y * unit.y;
        yz += weight * unit.y * unit.z;
        zz += weight * unit.z * unit.z;
    }
    CurvatureSum& operator+=(const CurvatureSum& b) {
        xx += b.xx;
        xy += b.xy;
        xz += b.xz;
        yy += b.yy;
        yz += b.yz;
        zz += b.zz;
        area += b.area;
        return *this;
    }
    /// The larger absolute value of the two curvatures. The third eigenvalue is about 0, so the sum of the
    /// other two is the trace, and the sum of their squares is the squared norm of the tensor.
    double largest() const {
        if (!(area > 0)) return 0;
        const double sum = xx + yy + zz,
                     squares = xx * xx + yy * yy + zz * zz + 2 * (xy * xy + xz * xz + yz * yz);
        return (std::abs(sum) + std::sqrt(std::max(0.0, 2 * squares - sum * sum))) / (2 * area);
    }
};

/// [vertices] the sums over the edges of each vertex, between faces that meet smoothly.
std::vector<CurvatureSum> curvature_sums(const WorkingMesh& m) {
    std::vector<CurvatureSum> sums(m.points.size());
    parallel_for(sums.size(), [&](std::size_t i) {
        const auto v = static_cast<Index>(i);
        if (m.out[v] == none || m.kinds[v] == VertexKind::many) return;
        CurvatureSum& sum = sums[v];
        m.around(v, [&](Index h) {
            const Vec3 n = m.face_normal(h / 3);
            sum.area += length(n) / 6;
            if (m.flags[h] & feature) return true;
            const Vec3 o = m.face_normal(m.twins[h] / 3), edge = m.points[m.to(h)] - m.points[v];
            const double size = length(edge);
            if (!(size > 0)) return true;
            const double angle = angle_between(n, o), side = dot(cross(n, o), edge) < 0 ? 1 : -1;
            sum.add(edge / size, side * angle * size / 2);
            return true;
        });
    });
    return sums;
}

/// The curvature of the feature line at v; 0 at its corners.
double curvature_of_line(const WorkingMesh& m, Index v, double feature_angle) {
    const auto ends = m.line_ends(v);
    if (!ends) return 0;
    const Vec3 in = m.points[v] - m.points[(*ends)[0]], on = m.points[(*ends)[1]] - m.points[v];
    const double turn = angle_between(in, on), size = length(in) + length(on);
    return turn > feature_angle || !(size > 0) ? 0 : 2 * turn / size;
}

} // namespace

void grade(const WorkingMesh& m, std::vector<double>& sizes) {
    constexpr double growth = 0.5;
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    for (Index v = 0; v < sizes.size(); ++v)
        if (m.out[v] != none && m.kinds[v] != VertexKind::many) open.emplace(sizes[v], v);
    while (!open.empty()) {
        const auto [size, v] = open.top();
        open.pop();
        if (size > sizes[v]) continue;
        m.neighbours(v, [&, size = size, v = v](Index w) {
            const double most = size + growth * length(m.points[w] - m.points[v]);
            if (!(most < sizes[w])) return;
            sizes[w] = most;
            if (m.kinds[w] != VertexKind::many) open.emplace(most, w);
        });
    }
}

std::vector<double> intended_sizes(const WorkingMesh& m, const RemeshSettings& s) {
    if (s.length > 0) return std::vector<double>(m.points.size(), s.length);
    std::vector<double> sizes(m.points.size(), s.max_length);
    const std::vector<CurvatureSum> sums = curvature_sums(m);
    parallel_for(sizes.size(), [&](std::size_t i) {
        const auto v = static_cast<Index>(i);
        if (m.out[v] == none || m.kinds[v] == VertexKind::many) return;
        CurvatureSum sum = sums[v]; // over the neighbours too, which removes noise
        m.neighbours(v, [&](Index w) { sum += sums[w]; });
        double curvature = sum.largest();
        if (m.kinds[v] == VertexKind::line)
            curvature = std::max(curvature, curvature_of_line(m, v, s.feature_angle));
        if (!(curvature * s.max_length * s.max_length > 6 * s.tolerance)) return;
        const double square = 6 * s.tolerance / curvature - 3 * s.tolerance * s.tolerance;
        sizes[v] = std::clamp(std::sqrt(std::max(0.0, square)), s.min_length, s.max_length);
    });
    grade(m, sizes);
    return sizes;
}

double expected_faces(const WorkingMesh& m, const std::vector<double>& sizes) {
    constexpr double equilateral = 0.4330127018922193; // the area of an equilateral triangle with side 1
    return parallel_reduce(
        m.face_slots(), 0.0,
        [&](std::size_t begin, std::size_t end) {
            double sum = 0;
            for (auto f = static_cast<Index>(begin); f < end; ++f) {
                double inverse = 0, longest = 0;
                for (Index k = 0; k < 3; ++k) {
                    const Index v = m.corners[3 * f + k], w = m.corners[3 * f + (k + 1) % 3];
                    inverse += 1 / (3 * sizes[v] * sizes[v]);
                    longest =
                        std::max(longest, length(m.points[w] - m.points[v]) / std::min(sizes[v], sizes[w]));
                }
                const double faces = length(m.face_normal(f)) / 2 * inverse / equilateral;
                if (faces > 0) sum += std::max(faces, longest - 2); // a sliver is cut along its edges only
            }
            return sum;
        },
        [](double a, double b) { return a + b; });
}

} // namespace facetmill::remeshing
