#include "geometry/measure/measure.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/measure/pieces.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "mesh/power_scale.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill {

namespace {

void add(Symmetric& s, const Symmetric& t) {
    s.xx += t.xx;
    s.xy += t.xy;
    s.xz += t.xz;
    s.yy += t.yy;
    s.yz += t.yz;
    s.zz += t.zz;
}

using Sums = MassSums;

void add(Sums& a, const Sums& b) {
    a.area += b.area;
    a.volume += b.volume;
    a.shell += b.shell;
    a.solid += b.solid;
    add(a.sheet, b.sheet);
    add(a.spread, b.spread);
}

/// Adds the tetrahedron from the origin to a triangle.
void add_tetrahedron(Sums& sums, const Vec3& a, const Vec3& b, const Vec3& c) {
    const double volume = dot(a, cross(b, c));
    const Vec3 sum = a + b + c;
    sums.volume += volume;
    sums.solid += sum * volume;
    for (const Vec3& v : {a, b, c, sum}) sums.spread.add_square(v, volume);
}

/// Adds a triangle of the shell. area: twice the triangle's area, negative where the fan of a concave
/// polygon turns back.
void add_sheet(Sums& sums, const Vec3& a, const Vec3& b, const Vec3& c, double area) {
    const Vec3 sum = a + b + c;
    sums.shell += sum * area;
    for (const Vec3& v : {a, b, c, sum}) sums.sheet.add_square(v, area);
}

void add_face(Sums& sums, const Mesh& mesh, Index f, const Vec3& from, std::vector<Vec3>& p) {
    p.clear();
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) p.push_back(mesh.point(c) - from);
    for (std::size_t i = 1; i + 1 < p.size(); ++i) add_tetrahedron(sums, p[0], p[i], p[i + 1]);
    const auto covering = covering_triangles(p);
    for (const auto& [a, b, c] : covering) {
        const double area = safe_length(cross(b - a, c - a));
        sums.area += area;
        add_sheet(sums, a, b, c, area);
    }
    if (!covering.empty()) return;
    const Vec3 twice = polygon::area_vector(p) * 2;
    const double area = safe_length(twice);
    const Vec3 normal = normalised(twice);
    sums.area += area;
    for (std::size_t i = 1; i + 1 < p.size(); ++i) {
        const double part = p.size() == 3 ? area : dot(cross(p[i] - p[0], p[i + 1] - p[0]), normal);
        add_sheet(sums, p[0], p[i], p[i + 1], part);
    }
}

Sums sums_of(const Mesh& mesh, const Vec3& from) {
    return parallel_reduce(
        mesh.face_count(), Sums{},
        [&](std::size_t begin, std::size_t end) {
            Sums sums;
            std::vector<Vec3> corners;
            for (std::size_t f = begin; f < end; ++f)
                add_face(sums, mesh, static_cast<Index>(f), from, corners);
            return sums;
        },
        [](Sums a, const Sums& b) {
            add(a, b);
            return a;
        });
}

Symmetric operator*(const Symmetric& s, double x) {
    return {s.xx * x, s.xy * x, s.xz * x, s.yy * x, s.yz * x, s.zz * x};
}

/// Rotates rows and columns p and q so that their common element becomes 0.
void rotate(double (&m)[3][3], double (&axes)[3][3], int p, int q) {
    if (m[p][q] == 0) return;
    const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
    const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
    const double c = 1 / std::sqrt(t * t + 1), s = t * c;
    for (int k = 0; k < 3; ++k) {
        const double kp = m[k][p], kq = m[k][q];
        m[k][p] = c * kp - s * kq;
        m[k][q] = s * kp + c * kq;
    }
    for (int k = 0; k < 3; ++k) {
        const double pk = m[p][k], qk = m[q][k];
        m[p][k] = c * pk - s * qk;
        m[q][k] = s * pk + c * qk;
    }
    m[p][q] = m[q][p] = 0;
    for (int k = 0; k < 3; ++k) {
        const double kp = axes[k][p], kq = axes[k][q];
        axes[k][p] = c * kp - s * kq;
        axes[k][q] = s * kp + c * kq;
    }
}

// Requires a mesh whose box has a size near 1. The sums are relative to a point.

ShellMass shell_of(const Sums& sums, const Vec3& from) {
    ShellMass shell;
    shell.area = sums.area / 2;
    if (!(sums.area > 0)) return shell;
    const Vec3 centroid = sums.shell / (3 * sums.area);
    shell.centroid = from + centroid;
    shell.spread = sums.sheet * (1.0 / 24);
    shell.spread.add_square(centroid, -shell.area);
    return shell;
}

SolidMass solid_of(const Sums& sums, const Vec3& from) {
    SolidMass solid;
    const double area = sums.area / 2, ball = area * std::sqrt(area / (36 * pi));
    if (!(std::abs(sums.volume / 6) > 1e-12 * ball)) return solid;
    solid.volume = sums.volume / 6;
    const Vec3 centroid = sums.solid / (4 * sums.volume);
    solid.centroid = from + centroid;
    solid.spread = sums.spread * (1.0 / 120);
    solid.spread.add_square(centroid, -solid.volume);
    return solid;
}

// Conversions from scaled to original coordinates.

/// measure: the power that scales the area or volume over which the moments were summed.
Symmetric taken_back(const Symmetric& s, const PowerScale& scale, int measure) {
    const auto moment = [&](double x, std::size_t i, std::size_t j) {
        return unscaled(x, measure + scale.powers[i] + scale.powers[j]);
    };
    return {moment(s.xx, 0, 0), moment(s.xy, 0, 1), moment(s.xz, 0, 2),
            moment(s.yy, 1, 1), moment(s.yz, 1, 2), moment(s.zz, 2, 2)};
}

ShellMass taken_back(const ShellMass& shell, const PowerScale& scale) {
    const int area = 2 * scale.powers[0]; // all axes have the same scale
    return {unscaled(shell.area, area), scale.inverse()(shell.centroid),
            taken_back(shell.spread, scale, area)};
}

SolidMass taken_back(const SolidMass& solid, const PowerScale& scale) {
    return {unscaled(solid.volume, scale.volume()), scale.inverse()(solid.centroid),
            taken_back(solid.spread, scale, scale.volume())};
}

Vec3 with_largest_positive(const Vec3& v) {
    std::size_t largest = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(v[i]) > std::abs(v[largest])) largest = i;
    return v[largest] < 0 ? -v : v;
}

} // namespace

Eigen3 eigen(const Symmetric& matrix) {
    double m[3][3] = {{matrix.xx, matrix.xy, matrix.xz},
                      {matrix.xy, matrix.yy, matrix.yz},
                      {matrix.xz, matrix.yz, matrix.zz}};
    double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int sweep = 0; sweep < 16; ++sweep) // converges quadratically: seven are enough
    {
        rotate(m, axes, 0, 1);
        rotate(m, axes, 0, 2);
        rotate(m, axes, 1, 2);
    }
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return m[a][a] < m[b][b]; });
    Eigen3 e;
    for (std::size_t i = 0; i < 3; ++i) {
        const int k = order[i];
        e.values[i] = m[k][k];
        e.vectors[i] = with_largest_positive(normalised({axes[0][k], axes[1][k], axes[2][k]}));
    }
    e.vectors[2] = cross(e.vectors[0], e.vectors[1]);
    return e;
}

Symmetric inertia_of(const Symmetric& s) {
    return {s.yy + s.zz, -s.xy, -s.xz, s.xx + s.zz, -s.yz, s.xx + s.yy};
}

ShellMass joined(const ShellMass& a, const ShellMass& b) {
    if (a.area == 0) return b;
    if (b.area == 0) return a;
    ShellMass sum{a.area + b.area, {}, a.spread};
    const Vec3 apart = b.centroid - a.centroid; // relative to a, as below
    sum.centroid = a.centroid + apart * (b.area / sum.area);
    add(sum.spread, b.spread);
    sum.spread.add_square(apart, a.area * (b.area / sum.area));
    return sum;
}

SolidMass joined(const SolidMass& a, const SolidMass& b) {
    if (a.volume == 0) return b;
    if (b.volume == 0) return a;
    SolidMass sum{a.volume + b.volume, {}, a.spread};
    if (sum.volume == 0) return {};
    // Computed relative to a, so that solids far from the origin keep their precision.
    const Vec3 apart = b.centroid - a.centroid;
    sum.centroid = a.centroid + apart * (b.volume / sum.volume);
    add(sum.spread, b.spread);
    sum.spread.add_square(apart, a.volume * (b.volume / sum.volume));
    return sum;
}

MassPieces::MassPieces(const Box& bounds)
    : even_(even_scale(bounds)), axes_(axis_scale(bounds)), plain_(even_.none() && axes_.none()) {
    if (bounds.empty()) return;
    even_from_ = Box{even_(bounds.min), even_(bounds.max)}.centre();
    axes_from_ = Box{axes_(bounds.min), axes_(bounds.max)}.centre();
}

void MassPieces::add(const Mesh& piece) {
    faces_ += piece.face_count();
    facetmill::add(even_sums_, sums_of(plain_ ? piece : even_(piece), even_from_));
    if (!plain_) facetmill::add(axes_sums_, sums_of(axes_(piece), axes_from_));
}

MassResult MassPieces::result(bool closed) const {
    MassResult result;
    result.shell = shell_of(even_sums_, even_from_);
    const bool solid = closed && faces_ > 0;
    if (solid) result.solid = solid_of(plain_ ? even_sums_ : axes_sums_, axes_from_);
    if (plain_) return result;
    result.shell = taken_back(result.shell, even_);
    if (solid) result.solid = taken_back(*result.solid, axes_);
    return result;
}

MassResult measure_mass(const Mesh& mesh) {
    MassPieces all(mesh.bounds());
    all.add(mesh);
    Properties p;
    set_connectivity(p, connectivity_of(mesh));
    return all.result(mesh.face_count() > 0 && p.closed);
}

namespace {

template <class Map>
double sum_of(const std::vector<double>& numbers, Map&& map) {
    return parallel_reduce(
        numbers.size(), 0.0,
        [&](std::size_t begin, std::size_t end) {
            double sum = 0;
            for (std::size_t i = begin; i < end; ++i) sum += map(numbers[i]);
            return sum;
        },
        [](double a, double b) { return a + b; });
}

} // namespace

Statistics statistics(std::vector<double> numbers) {
    std::erase_if(numbers, [](double x) { return !std::isfinite(x); });
    Statistics s;
    s.count = numbers.size();
    if (numbers.empty()) return s;
    const auto count = static_cast<double>(s.count);
    const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
    s.minimum = *low;
    s.maximum = *high;
    s.sum = sum_of(numbers, [](double x) { return x; });
    s.mean = s.sum / count;
    const double mean = s.mean;
    s.deviation = std::sqrt(sum_of(numbers, [mean](double x) { return (x - mean) * (x - mean); }) / count);
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(s.count / 2);
    std::nth_element(numbers.begin(), middle, numbers.end());
    s.median = *middle;
    return s;
}

} // namespace facetmill
