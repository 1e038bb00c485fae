#pragma once
// Numbers that are near those before them, in few bytes: differences, one byte for a small one.

#include "io/bytes.hpp"

#include <cstdint>

namespace facetmill::cells {

namespace packed {
// A difference has its sign in the lowest bit, and seven bits in a byte, the lowest first; the highest bit of
// a byte says that another follows.
inline constexpr int digit = 7;
inline constexpr std::uint64_t more = std::uint64_t{1} << digit;
} // namespace packed

/// Calls put(byte) for each byte of the difference of a number from the one before it.
template <class Put>
void put_difference(std::uint64_t before, std::uint64_t number, Put&& put) {
    const bool down = number < before;
    std::uint64_t left = (down ? before - number : number - before) << 1 | (down ? 1 : 0);
    for (; left >= packed::more; left >>= packed::digit) put(static_cast<std::byte>(left | packed::more));
    put(static_cast<std::byte>(left));
}

/// The number behind the one before it. next(): the next byte.
template <class Next>
std::uint64_t take_difference(std::uint64_t before, Next&& next) {
    constexpr int most = 63;
    std::uint64_t difference = 0, byte = packed::more;
    for (int shift = 0; byte & packed::more && shift < most; shift += packed::digit) {
        byte = std::to_integer<std::uint64_t>(next());
        difference |= (byte & (packed::more - 1)) << shift;
    }
    return difference & 1 ? before - (difference >> 1) : before + (difference >> 1);
}

/// Numbers of 32 bits, this machine's, in fewer bytes; where they are not fewer, as they are and one byte
/// more.
io::Bytes packed_numbers(io::Span numbers);
/// Appends what was packed. False where the bytes are not such ones.
bool unpack_numbers(io::Span packed, io::Bytes& to);

} // namespace facetmill::cells
