#include "geometry/generate/lattice.hpp"

#include "base/parallel.hpp"

#include <array>
#include <bit>

namespace facetmill {

namespace {

/// Quads whose corners are points of a lattice of n cells a side, by the key of the point.
struct LatticeQuads {
    std::uint64_t n;
    std::vector<std::uint64_t> keys = {}; ///< four to a quad

    std::uint64_t key(const std::array<std::uint64_t, 3>& p) const {
        return (p[2] * (n + 1) + p[1]) * (n + 1) + p[0];
    }
    /// The side of cell c towards the positive or negative end of an axis, seen anticlockwise from there.
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
    /// Lattice coordinate to [-1/2, 1/2]; opposite points get exactly opposite values.
    double place(std::uint64_t i) const {
        return (2 * static_cast<double>(i) - static_cast<double>(n)) / (2 * static_cast<double>(n));
    }
    Mesh mesh() const;
};

/// Vertices in the order of their keys.
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

} // namespace

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

} // namespace facetmill
