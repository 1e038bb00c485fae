// Finds the number of bits that positions need to keep vertices distinct.

#include "io/gltf/draco/draco.hpp"
#include "io/gltf/draco/quantise.hpp"
#include "io/gltf/gltf.hpp"

#include "parallel/parallel.hpp"

#include <array>
#include <atomic>
#include <bit>

namespace facetmill::io {

namespace {

using Place = std::array<std::uint32_t, 3>;

/// The number of distinct positions.
std::size_t count_positions(std::vector<Place>& places) {
    for (const std::size_t i : {0u, 1u, 2u})
        radix_sort(
            places, [i](const Place& p) { return p[i]; }, 32);
    std::atomic<std::size_t> count = 0;
    parallel_chunks(places.size(), [&](std::size_t begin, std::size_t end) {
        std::size_t here = 0;
        for (std::size_t i = begin; i < end; ++i) here += i == 0 || places[i] != places[i - 1];
        count += here;
    });
    return count;
}

/// The grid coordinates of each vertex as written. Without a grid, the bits of the float32 coordinates.
std::vector<Place> places_of(const Mesh& mesh, const DracoInput& grid, std::optional<int> bits) {
    std::vector<Place> places(mesh.vertex_count());
    const float density = bits ? DracoGrid{{}, grid.range, *bits}.density() : 0;
    parallel_for(places.size(), [&](std::size_t v) {
        for (std::size_t i = 0; i < 3; ++i) {
            const float x = static_cast<float>(mesh.positions[v][i]), origin = grid.origin[i];
            places[v][i] = bits ? step_of(settled(x, origin, density), origin, density)
                                : std::bit_cast<std::uint32_t>(x - origin + 0.0f); // -0 becomes 0
        }
    });
    return places;
}

} // namespace

std::optional<int> bits_that_keep_distinct(const Mesh& mesh, int min_bits) {
    DracoInput grid;
    set_draco_grid(mesh, grid);
    std::vector<Place> places = places_of(mesh, grid, {});
    const std::size_t given = count_positions(places);
    for (int bits = min_bits; bits <= 24; ++bits) {
        places = places_of(mesh, grid, bits);
        if (count_positions(places) == given) return bits;
    }
    return {};
}

} // namespace facetmill::io
