#include "cells/storage/packed_numbers.hpp"

#include "base/math/random.hpp"
#include "support/catch.hpp"

using namespace facetmill;
using namespace facetmill::cells;

namespace {

io::Bytes bytes_of_numbers(const std::vector<std::uint32_t>& numbers) {
    const auto bytes = std::as_bytes(std::span(numbers));
    return {bytes.begin(), bytes.end()};
}

} // namespace

TEST_CASE("numbers are packed and unpacked", "[cells]") {
    std::vector<std::uint32_t> near, far;
    for (std::uint32_t i = 0; i < 5000; ++i) {
        near.push_back(1000000 + i / 3 + static_cast<std::uint32_t>(hashed(1, i) % 40));
        far.push_back(static_cast<std::uint32_t>(hashed(2, i)));
    }
    const std::vector<std::uint32_t> ends{0, UINT32_MAX, 0, UINT32_MAX - 1, 1, 1U << 31, 127, 128, 0};
    for (const auto& numbers : {near, far, ends, {}, {7}}) {
        const io::Bytes bytes = bytes_of_numbers(numbers), packed = packed_numbers(bytes);
        CHECK(packed.size() <= bytes.size() + 1);
        io::Bytes again{std::byte{9}}; // is appended to
        REQUIRE(unpack_numbers(packed, again));
        CHECK(io::Bytes(again.begin() + 1, again.end()) == bytes);
    }
    CHECK(packed_numbers(bytes_of_numbers(near)).size() < near.size() + 10);
    CHECK(packed_numbers(bytes_of_numbers(far)).size() == sizeof(std::uint32_t) * far.size() + 1);
    io::Bytes ignored;
    CHECK_FALSE(unpack_numbers({}, ignored));
    CHECK_FALSE(unpack_numbers(io::Bytes{std::byte{7}, std::byte{2}}, ignored));
}
