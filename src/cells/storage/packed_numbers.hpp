#pragma once
// Packs numbers close to their predecessors as differences. Small differences take a single byte.

#include "io/bytes.hpp"

#include <cstdint>

namespace facetmill::cells {

namespace packed {
// A difference has its sign in the lowest bit. Each byte has seven bits, lowest first; its highest bit marks
// that another byte follows.
inline constexpr int digit = 7;
inline constexpr std::uint64_t more = std::uint64_t{1} << digit;
} // namespace packed

/// Calls put(byte) for each byte of the difference between a number and its predecessor.
template <class Put>
void put_difference(std::uint64_t before, std::uint64_t number, Put&& put) {
    const bool down = number < before;
    std::uint64_t left = (down ? before - number : number - before) << 1 | (down ? 1 : 0);
    for (; left >= packed::more; left >>= packed::digit) put(static_cast<std::byte>(left | packed::more));
    put(static_cast<std::byte>(left));
}

/// The number after `before`. next(): returns the next byte.
template <class Next>
[[nodiscard]] std::uint64_t take_difference(std::uint64_t before, Next&& next) {
    constexpr int most = 63;
    std::uint64_t difference = 0, byte = packed::more;
    for (int shift = 0; byte & packed::more && shift < most; shift += packed::digit) {
        byte = std::to_integer<std::uint64_t>(next());
        difference |= (byte & (packed::more - 1)) << shift;
    }
    return difference & 1 ? before - (difference >> 1) : before + (difference >> 1);
}

/// Packs native 32-bit numbers. If that does not save space, the result is the numbers plus one byte.
[[nodiscard]] io::Bytes packed_numbers(io::Span numbers);
/// Appends the unpacked numbers. False if the bytes are not valid packed numbers.
bool unpack_numbers(io::Span packed, io::Bytes& to);

} // namespace facetmill::cells
