#include "cells/storage/packed_numbers.hpp"

#include <array>
#include <bit>
#include <cstring>

namespace facetmill::cells {

namespace {

constexpr std::byte as_they_are{0}, as_differences{1};
constexpr std::size_t number_bytes = sizeof(std::uint32_t);

} // namespace

io::Bytes packed_numbers(io::Span numbers) {
    io::Bytes packed(1, as_differences);
    packed.reserve(numbers.size() + 1);
    std::uint32_t before = 0;
    for (std::size_t at = 0; at < numbers.size() && packed.size() <= numbers.size(); at += number_bytes) {
        std::uint32_t number = 0;
        std::memcpy(&number, numbers.data() + at, number_bytes);
        put_difference(before, number, [&](std::byte byte) { packed.push_back(byte); });
        before = number;
    }
    if (packed.size() <= numbers.size()) return packed;
    packed.assign(1, as_they_are);
    packed.insert(packed.end(), numbers.begin(), numbers.end());
    return packed;
}

bool unpack_numbers(io::Span packed, io::Bytes& to) {
    if (packed.empty()) return false;
    const std::byte how = packed.front();
    packed = packed.subspan(1);
    if (how == as_they_are) {
        to.insert(to.end(), packed.begin(), packed.end());
        return true;
    }
    std::uint32_t before = 0;
    for (std::size_t at = 0; at < packed.size();) {
        before = static_cast<std::uint32_t>(
            take_difference(before, [&] { return at < packed.size() ? packed[at++] : std::byte{}; }));
        const auto raw = std::bit_cast<std::array<std::byte, number_bytes>>(before);
        to.insert(to.end(), raw.begin(), raw.end());
    }
    return how == as_differences;
}

} // namespace facetmill::cells
