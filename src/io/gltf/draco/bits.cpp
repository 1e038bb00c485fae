// How many bits of position keep vertices apart.

#include "base/parallel.hpp"
#include "io/gltf/draco/draco.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>

namespace facetmill::io {

namespace {

using Place = std::array<std::uint32_t, 3>;

/// The number of different places.
std::size_t count_places(std::vector<Place>& places) {
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

/// The step of the grid at each vertex, with Draco's own arithmetic, or the coordinates' own bits.
std::vector<Place> places_of(const Mesh& mesh, const DracoInput& grid, std::optional<int> bits) {
    std::vector<Place> places(mesh.vertex_count());
    const float steps = bits ? static_cast<float>((1u << *bits) - 1) / grid.range : 0;
    parallel_for(places.size(), [&](std::size_t v) {
        for (std::size_t i = 0; i < 3; ++i) {
            const float x = static_cast<float>(mesh.positions[v][i]) - grid.origin[i];
            places[v][i] = bits ? static_cast<std::uint32_t>(std::max(0.0f, std::floor(x * steps + 0.5f)))
                                : std::bit_cast<std::uint32_t>(x + 0.0f); // -0 is 0
        }
    });
    return places;
}

} // namespace

std::optional<int> bits_that_keep_apart(const Mesh& mesh, int least) {
    DracoInput grid;
    set_draco_grid(mesh, grid);
    std::vector<Place> places = places_of(mesh, grid, {});
    const std::size_t given = count_places(places);
    for (int bits = least; bits <= 24; ++bits) {
        places = places_of(mesh, grid, bits);
        if (count_places(places) == given) return bits;
    }
    return {};
}

} // namespace facetmill::io
