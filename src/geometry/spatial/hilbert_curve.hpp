#pragma once
// A Hilbert curve through a box: items sorted along it are near each other in space and in memory.

#include "base/math/vec.hpp"
#include "mesh/mesh.hpp"
#include "parallel/parallel.hpp"

#include <array>
#include <span>
#include <vector>

namespace facetmill {

namespace hilbert {

inline constexpr int axis_bits = 11; ///< 33 bits in all: three passes of the radix sort

/// One step down the curve: the index of the cell among the eight, and the state inside it.
struct Step {
    std::uint8_t turn, state;
};

/// States are the corner at which the curve enters a cell (3 bits) and its direction (0 to 2), after C.
/// Hamilton and A. Rau-Chaplin, "Compact Hilbert indices" (2008).
[[nodiscard]] constexpr std::array<std::array<Step, 8>, 24> make_steps() {
    constexpr auto rotated = [](unsigned x, unsigned by) { return (x << by | x >> (3 - by)) & 7; };
    constexpr auto gray = [](unsigned w) { return w ^ w >> 1; };
    constexpr auto trailing_ones = [](unsigned w) {
        unsigned n = 0;
        for (; w & 1; w >>= 1) ++n;
        return n;
    };
    std::array<std::array<Step, 8>, 24> steps{};
    for (unsigned enter = 0; enter < 8; ++enter)
        for (unsigned direction = 0; direction < 3; ++direction)
            for (unsigned turn = 0; turn < 8; ++turn) {
                const unsigned by = (direction + 1) % 3;
                const unsigned cell = rotated(gray(turn), by) ^ enter;
                const unsigned first = turn == 0 ? 0 : gray(2 * ((turn - 1) / 2));
                const unsigned along = turn == 0 ? 0 : trailing_ones(turn % 2 == 0 ? turn - 1 : turn) % 3;
                const unsigned next = (enter ^ rotated(first, by)) * 3 + (direction + along + 1) % 3;
                steps[enter * 3 + direction][cell] = {static_cast<std::uint8_t>(turn),
                                                      static_cast<std::uint8_t>(next)};
            }
    return steps;
}
inline constexpr auto steps = make_steps();

/// Two steps at once, into one of 64 cells. The index has two bits of x, then two of y and two of z.
[[nodiscard]] constexpr std::array<std::array<Step, 64>, 24> make_double_steps() {
    std::array<std::array<Step, 64>, 24> doubles{};
    for (std::size_t state = 0; state < doubles.size(); ++state)
        for (unsigned cell = 0; cell < 64; ++cell) {
            const Step outer = steps[state][(cell >> 1 & 1) | (cell >> 3 & 1) << 1 | (cell >> 5 & 1) << 2];
            const Step inner = steps[outer.state][(cell & 1) | (cell >> 2 & 1) << 1 | (cell >> 4 & 1) << 2];
            doubles[state][cell] = {static_cast<std::uint8_t>(outer.turn << 3 | inner.turn), inner.state};
        }
    return doubles;
}
inline constexpr auto double_steps = make_double_steps();

/// The position along the curve of the cell with these coordinates, axis_bits each.
[[nodiscard]] constexpr std::uint64_t index(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    static_assert(axis_bits % 2 == 1, "one step, then two at a time");
    constexpr int top = axis_bits - 1;
    const Step first = steps[0][(x >> top & 1) | (y >> top & 1) << 1 | (z >> top & 1) << 2];
    std::uint64_t along = first.turn;
    std::size_t state = first.state;
    for (int bit = top - 2; bit >= 0; bit -= 2) {
        const Step step = double_steps[state][(x >> bit & 3) | (y >> bit & 3) << 2 | (z >> bit & 3) << 4];
        along = along << 6 | step.turn;
        state = step.state;
    }
    return along;
}

/// The position of a point in the box. Points outside count as on its border, and NaN as its lower corner.
[[nodiscard]] inline std::uint64_t index(const Vec3& p, const Box& all) {
    std::array<std::uint32_t, 3> cell{};
    constexpr double cells = (1 << axis_bits) - 1;
    for (std::size_t i = 0; i < 3; ++i) {
        const double extent = all.max[i] - all.min[i];
        const double t = extent > 0 ? (p[i] - all.min[i]) / extent * cells : 0;
        cell[i] = t >= cells ? static_cast<std::uint32_t>(cells) : t > 0 ? static_cast<std::uint32_t>(t) : 0;
    }
    return index(cell[0], cell[1], cell[2]);
}

} // namespace hilbert

/// The numbers 0 to count - 1 in the order of centre_of(i) along the curve through `all`. Equal positions
/// are sorted by number.
template <class CentreOf>
[[nodiscard]] std::vector<Index> order_along_curve(std::size_t count, const Box& all, CentreOf&& centre_of) {
    constexpr int place_bits = 3 * hilbert::axis_bits, item_bits = 64 - place_bits;
    std::vector<Index> order(count);
    if (count <=
        std::size_t{1} << item_bits) { // key and index in the same number: half of the memory to sort
        std::vector<std::uint64_t> placed(count);
        parallel_for(count,
                     [&](std::size_t i) { placed[i] = hilbert::index(centre_of(i), all) << item_bits | i; });
        radix_sort(
            placed, [](std::uint64_t p) { return p >> item_bits; }, place_bits);
        constexpr std::uint64_t item = (std::uint64_t{1} << item_bits) - 1;
        parallel_for(count, [&](std::size_t i) { order[i] = static_cast<Index>(placed[i] & item); });
        return order;
    }
    struct Placed {
        std::uint64_t along;
        Index item;
    };
    std::vector<Placed> placed(count);
    parallel_for(count, [&](std::size_t i) {
        placed[i] = {hilbert::index(centre_of(i), all), static_cast<Index>(i)};
    });
    radix_sort(
        placed, [](const Placed& p) { return p.along; }, place_bits);
    parallel_for(count, [&](std::size_t i) { order[i] = placed[i].item; });
    return order;
}

} // namespace facetmill
