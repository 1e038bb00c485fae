#include "geometry/generate/generate.hpp"

#include "base/error.hpp"
#include "base/math/numbers.hpp"
#include "base/math/portable_math.hpp"
#include "geometry/crumple/crumple.hpp"
#include "mesh/mesh.hpp"
#include "mesh/shapes.hpp"
#include "parallel/memory.hpp"
#include "parallel/parallel.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <fmt/format.h>
#include <tuple>

namespace facetmill {

namespace {

// Surfaces on a cubic lattice: cube and Menger sponge.

/// Quads whose corners are points of a lattice with n cells a side. A key identifies each point.
struct LatticeQuads {
    std::uint64_t n;
    std::vector<std::uint64_t> keys = {}; ///< four per quad

    std::uint64_t key(const std::array<std::uint64_t, 3>& p) const {
        return (p[2] * (n + 1) + p[1]) * (n + 1) + p[0];
    }
    /// The side of cell c towards the positive or negative end of an axis, seen anticlockwise from that end.
    void add(std::array<std::uint64_t, 3> c, std::size_t axis, bool positive) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        c[axis] += positive;
        auto across = c, along = c;
        ++across[u];
        ++along[v];
        auto far = across;
        ++far[v];
        if (!positive) std::swap(across, along);
        for (const auto& p : {c, across, far, along}) keys.push_back(key(p));
    }
    /// Maps a lattice coordinate to [-1/2, 1/2]. Opposite points get exactly opposite values.
    double place(std::uint64_t i) const {
        return (2 * static_cast<double>(i) - static_cast<double>(n)) / (2 * static_cast<double>(n));
    }
    Mesh mesh() const;
};

/// Makes the mesh, with vertices in the order of their keys.
Mesh LatticeQuads::mesh() const {
    struct Corner {
        std::uint64_t key;
        Index corner;
    };
    std::vector<Corner> order(keys.size());
    parallel_for(keys.size(), [&](std::size_t c) { order[c] = {keys[c], static_cast<Index>(c)}; });
    radix_sort(
        order, [](const Corner& c) { return c.key; }, std::bit_width((n + 1) * (n + 1) * (n + 1)));
    Mesh mesh;
    mesh.corners.resize(keys.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || order[i].key != order[i - 1].key) {
            const std::uint64_t k = order[i].key, row = k / (n + 1);
            mesh.positions.push_back({place(k % (n + 1)), place(row % (n + 1)), place(row / (n + 1))});
        }
        mesh.corners[order[i].corner] = static_cast<Index>(mesh.positions.size() - 1);
    }
    mesh.face_offsets.resize(keys.size() / 4 + 1);
    for (std::size_t f = 0; f < mesh.face_offsets.size(); ++f)
        mesh.face_offsets[f] = static_cast<Index>(4 * f);
    return mesh;
}

/// Whether a cell belongs to the sponge: in base 3, no place has the digit 1 in two coordinates.
bool solid(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    for (; x > 0 || y > 0 || z > 0; x /= 3, y /= 3, z /= 3)
        if ((x % 3 == 1) + (y % 3 == 1) + (z % 3 == 1) > 1) return false;
    return true;
}

/// The surface of the cube of side 1 around the origin, cells x cells quads on each side.
Mesh lattice_cube(std::int64_t cells) {
    const auto n = static_cast<std::uint64_t>(cells);
    LatticeQuads quads{n};
    quads.keys.reserve(24 * n * n);
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const bool positive : {false, true})
            for (std::uint64_t j = 0; j < n; ++j)
                for (std::uint64_t i = 0; i < n; ++i) {
                    std::array<std::uint64_t, 3> cell{};
                    cell[axis] = positive ? n - 1 : 0;
                    cell[(axis + 1) % 3] = i;
                    cell[(axis + 2) % 3] = j;
                    quads.add(cell, axis, positive);
                }
    return quads.mesh();
}

/// The outer surface of the Menger sponge of side 1 around the origin. It has a quad for every lattice face
/// between the sponge and empty space: 2 * 20^level + 4 * 8^level quads, closed and manifold. level 0 to 6.
Mesh lattice_sponge(int level) {
    std::uint64_t n = 1;
    for (int i = 0; i < level; ++i) n *= 3;
    LatticeQuads quads{n};
    const auto filled = [&](std::array<std::uint64_t, 3> c, std::size_t axis, bool positive) {
        if (positive ? c[axis] == n - 1 : c[axis] == 0) return false;
        c[axis] = positive ? c[axis] + 1 : c[axis] - 1;
        return solid(c[0], c[1], c[2]);
    };
    for (std::uint64_t z = 0; z < n; ++z)
        for (std::uint64_t y = 0; y < n; ++y)
            for (std::uint64_t x = 0; x < n; ++x) {
                if (!solid(x, y, z)) continue;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    for (const bool positive : {false, true})
                        if (!filled({x, y, z}, axis, positive)) quads.add({x, y, z}, axis, positive);
            }
    return quads.mesh();
}

void need(bool holds, std::string_view what, const std::string& found, std::string hint = {}) {
    if (!holds)
        throw Error(ErrorKind::usage, "E-RANGE", fmt::format("generate: {}, not {}", what, found),
                    std::move(hint));
}
void need_length(double x, std::string_view name) {
    constexpr double most = 1e37; // a diagonal of this length still fits float32
    need(x > 0, fmt::format("{} is above 0", name), to_string(x));
    need(x <= most, fmt::format("{} must be at most 1e+37, because files hold float32", name), to_string(x),
         "use a smaller length, or a larger unit");
}
void need_count(std::int64_t n, std::int64_t least, std::string_view name) {
    need(n >= least, fmt::format("{} is at least {}", name, least), std::to_string(n));
}

void refuse_giants(const GenerateSettings& s) {
    const double faces = generate_face_estimate(s);
    if (3 * faces > 2147483648.0)
        throw Error(
            ErrorKind::limit, "E-LIMIT",
            fmt::format("generate: the shape would have about {:.3g} faces, but at most {:.3g} are possible",
                        faces, 2147483648.0 / 3),
            "ask for fewer faces, cells or subdivisions");
    // Memory per triangle: three corners and half a vertex, twice while quads are cut, plus memory for
    // sorting.
    require_memory(100 * faces, fmt::format("generate: a shape of {:.3g} faces", faces),
                   "ask for fewer faces, cells or subdivisions");
}

/// Points in rows of `segments`. at(r, i) is point i of row r.
struct Rows {
    Index segments, first = 0;
    Index at(Index row, Index i) const { return first + row * segments + i % segments; }
};

void add_quad(Mesh& mesh, Index a, Index b, Index c, Index d) {
    const Index quad[] = {a, b, c, d};
    add_face(mesh, quad);
}
void add_triangle(Mesh& mesh, Index a, Index b, Index c) {
    const Index triangle[] = {a, b, c};
    add_face(mesh, triangle);
}

struct Direction {
    double cosine, sine;
};
/// The n directions around a circle, computed once for all rows.
std::vector<Direction> circle(std::int64_t n) {
    std::vector<Direction> all(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double a = 2 * pi * static_cast<double>(i) / static_cast<double>(n);
        all[i] = {cosine(a), sine(a)};
    }
    return all;
}

void add_ring(Mesh& mesh, const std::vector<Direction>& directions, double radius, double z) {
    for (const auto& d : directions) mesh.positions.push_back({radius * d.cosine, radius * d.sine, z});
}

/// Adds quads between a row and the row above it.
void add_band(Mesh& mesh, const Rows& rows, Index below, Index above) {
    for (Index i = 0; i < rows.segments; ++i)
        add_quad(mesh, rows.at(below, i), rows.at(below, i + 1), rows.at(above, i + 1), rows.at(above, i));
}
/// Adds triangles from a row to a point above it (up) or below it.
void add_fan(Mesh& mesh, const Rows& rows, Index row, Index apex, bool up) {
    for (Index i = 0; i < rows.segments; ++i)
        up ? add_triangle(mesh, rows.at(row, i), rows.at(row, i + 1), apex)
           : add_triangle(mesh, rows.at(row, i + 1), rows.at(row, i), apex);
}

Mesh sphere(const GenerateSettings& s) {
    Mesh mesh;
    const auto directions = circle(s.segments);
    const Index bands = static_cast<Index>(s.rings), inner = bands - 1;
    for (Index r = 1; r <= inner; ++r) {
        const double a = pi * r / bands;
        add_ring(mesh, directions, s.radius * sine(a), -s.radius * cosine(a));
    }
    mesh.positions.push_back({0, 0, -s.radius});
    mesh.positions.push_back({0, 0, s.radius});
    const Rows rows{static_cast<Index>(s.segments)};
    const auto south = static_cast<Index>(mesh.positions.size() - 2);
    add_fan(mesh, rows, 0, south, false);
    for (Index r = 0; r + 1 < inner; ++r) add_band(mesh, rows, r, r + 1);
    add_fan(mesh, rows, inner - 1, south + 1, true);
    return mesh;
}

Mesh torus(const GenerateSettings& s) {
    Mesh mesh;
    const auto directions = circle(s.segments);
    for (const auto& tube : circle(s.rings))
        add_ring(mesh, directions, s.radius + s.minor_radius * tube.cosine, s.minor_radius * tube.sine);
    const Rows rows{static_cast<Index>(s.segments)};
    const auto rings = static_cast<Index>(s.rings);
    for (Index r = 0; r < rings; ++r) add_band(mesh, rows, r, (r + 1) % rings);
    return mesh;
}

Mesh cylinder(const GenerateSettings& s) {
    Mesh mesh;
    const auto directions = circle(s.segments);
    const auto rings = static_cast<Index>(s.rings);
    for (Index r = 0; r <= rings; ++r)
        add_ring(mesh, directions, s.radius, s.height * (static_cast<double>(r) / rings - 0.5));
    const Rows rows{static_cast<Index>(s.segments)};
    for (Index r = 0; r < rings; ++r) add_band(mesh, rows, r, r + 1);
    if (!s.caps) return mesh;
    const auto centre = static_cast<Index>(mesh.positions.size());
    mesh.positions.push_back({0, 0, -s.height / 2});
    mesh.positions.push_back({0, 0, s.height / 2});
    add_fan(mesh, rows, 0, centre, false);
    add_fan(mesh, rows, rings, centre + 1, true);
    return mesh;
}

Mesh cone(const GenerateSettings& s) {
    Mesh mesh;
    const auto directions = circle(s.segments);
    const auto rings = static_cast<Index>(s.rings);
    for (Index r = 0; r < rings; ++r) {
        const double t = static_cast<double>(r) / rings;
        add_ring(mesh, directions, s.radius * (1 - t), s.height * (t - 0.5));
    }
    mesh.positions.push_back({0, 0, s.height / 2});
    const Rows rows{static_cast<Index>(s.segments)};
    const auto apex = static_cast<Index>(mesh.positions.size() - 1);
    for (Index r = 0; r + 1 < rings; ++r) add_band(mesh, rows, r, r + 1);
    add_fan(mesh, rows, rings - 1, apex, true);
    if (!s.caps) return mesh;
    mesh.positions.push_back({0, 0, -s.height / 2});
    add_fan(mesh, rows, 0, apex + 1, false);
    return mesh;
}

/// A square of cells x cells quads around the origin, at the height height(x, y).
template <class Height>
Mesh field(const GenerateSettings& s, Height&& height) {
    Mesh mesh;
    const auto n = static_cast<Index>(s.cells);
    const auto place = [&](Index i) { return s.size * ((2.0 * i - n) / (2.0 * n)); };
    for (Index j = 0; j <= n; ++j)
        for (Index i = 0; i <= n; ++i)
            mesh.positions.push_back({place(i), place(j), height(place(i), place(j))});
    for (Index j = 0; j < n; ++j)
        for (Index i = 0; i < n; ++i) {
            const Index a = j * (n + 1) + i, b = a + n + 1;
            add_quad(mesh, a, a + 1, b + 1, b);
        }
    return mesh;
}

Mesh scaled(Mesh mesh, double size) {
    for (auto& p : mesh.positions) p *= size;
    return mesh;
}

Mesh shaped(const GenerateSettings& s) {
    switch (s.shape) {
    case Shape::sphere:
        return sphere(s);
    case Shape::icosphere:
        return scaled(shapes::icosphere(static_cast<int>(s.subdivisions)), s.radius);
    case Shape::cube:
        return scaled(lattice_cube(s.cells), s.size);
    case Shape::grid:
        return field(s, [](double, double) { return 0.0; });
    case Shape::torus:
        return torus(s);
    case Shape::cylinder:
        return cylinder(s);
    case Shape::cone:
        return cone(s);
    case Shape::gaussian:
        return field(s, [&](double x, double y) {
            return s.height * exponential(-(x * x + y * y) / (2 * s.spread * s.spread));
        });
    case Shape::menger:
        return scaled(lattice_sponge(static_cast<int>(s.subdivisions)), s.size);
    }
    throw Error(ErrorKind::bug, "E-BUG", "generate: unknown shape");
}

} // namespace

double generate_face_estimate(const GenerateSettings& s) {
    const double segments = static_cast<double>(s.segments), rings = static_cast<double>(s.rings),
                 cells = static_cast<double>(s.cells);
    const auto power = [&](double base) {
        double x = 1;
        for (std::int64_t i = 0; i < s.subdivisions && x < 1e18; ++i) x *= base;
        return x;
    };
    switch (s.shape) {
    case Shape::sphere:
        return 2 * segments * (rings - 1);
    case Shape::icosphere:
        return 20 * power(4);
    case Shape::cube:
        return 12 * cells * cells;
    case Shape::torus:
        return 2 * segments * rings;
    case Shape::cylinder:
        return 2 * segments * (rings + s.caps);
    case Shape::cone:
        return segments * (2 * rings - 1 + s.caps);
    case Shape::grid:
    case Shape::gaussian:
        return 2 * cells * cells;
    case Shape::menger:
        return 4 * power(20) + 8 * power(8);
    }
    return 0;
}

void check_generate_settings(const GenerateSettings& s) {
    const bool square = s.shape == Shape::cube || s.shape == Shape::grid || s.shape == Shape::gaussian;
    const bool tall = s.shape == Shape::cylinder || s.shape == Shape::cone;
    need(s.noise >= 0 && s.noise <= 1e37, "noise must be at least 0 and at most 1e+37", to_string(s.noise));
    if (square || s.shape == Shape::menger)
        need_length(s.size, "size");
    else
        need_length(s.radius, "radius");
    if (square) need_count(s.cells, 1, "cells");
    if (tall || s.shape == Shape::gaussian) need_length(s.height, "height");
    if (s.shape == Shape::gaussian) need_length(s.spread, "spread");
    if (s.shape == Shape::torus) {
        need_length(s.minor_radius, "minor_radius");
        need(s.minor_radius < s.radius,
             fmt::format("minor_radius must be below the radius {}", to_string(s.radius)),
             to_string(s.minor_radius), "use a smaller minor_radius or a larger radius");
    }
    const bool round = tall || s.shape == Shape::sphere || s.shape == Shape::torus;
    if (round) need_count(s.segments, 3, "segments");
    if (round) need_count(s.rings, s.shape == Shape::torus ? 3 : s.shape == Shape::sphere ? 2 : 1, "rings");
    if (s.shape == Shape::menger)
        need(s.subdivisions >= 1 && s.subdivisions <= 4, "subdivisions is 1 to 4",
             std::to_string(s.subdivisions));
    if (s.shape == Shape::icosphere)
        need(s.subdivisions >= 0 && s.subdivisions <= 12, "subdivisions is 0 to 12",
             std::to_string(s.subdivisions));
}

SphereBands sphere_bands(std::int64_t faces) {
    const std::int64_t half = std::max<std::int64_t>(faces, 6) / 2; // segments * (rings - 1)
    SphereBands best;
    std::int64_t best_miss = 0, best_count = 0;
    double best_skew = 0;
    const auto consider = [&](std::int64_t segments, std::int64_t rings) {
        if (rings < 2 || segments < rings || segments > 4 * rings) return;
        const std::int64_t count = 2 * segments * (rings - 1), miss = std::abs(count - faces);
        const double ratio = static_cast<double>(segments) / (2 * static_cast<double>(rings)),
                     skew = std::max(ratio, 1 / ratio);
        const auto rank = std::tuple(miss, count, skew);
        if (best.segments > 0 && !(rank < std::tuple(best_miss, best_count, best_skew))) return;
        best = {segments, rings};
        best_miss = miss;
        best_count = count;
        best_skew = skew;
    };
    // At most 4 segments are used for each ring, and rings - 1 is half / segments, rounded down or up.
    for (std::int64_t segments = 3; segments <= 12 || segments * segments <= 16 * half; ++segments)
        for (std::int64_t rings = half / segments + 1; rings <= half / segments + 2; ++rings)
            consider(segments, rings);
    return best;
}

Mesh with_noise(Mesh mesh, double deviation, std::uint64_t seed) {
    if (deviation == 0) return mesh;
    CrumpleSettings noise;
    noise.amplitude = deviation;
    noise.seed = seed;
    return std::move(crumple(std::move(mesh), noise).mesh);
}

Mesh generate(const GenerateSettings& settings) {
    check_generate_settings(settings);
    refuse_giants(settings);
    Mesh mesh = shaped(settings);
    if (!settings.quads) mesh = triangulated(mesh);
    return with_noise(std::move(mesh), settings.noise, settings.seed);
}

} // namespace facetmill
