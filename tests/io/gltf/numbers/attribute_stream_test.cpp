// Streams of KHR_meshopt_compression in version 1: round trips, streams of another encoder, damage.
#include "io/gltf/numbers/attribute_stream.hpp"

#include "base/math/random.hpp"
#include "io/gltf/document/container.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"

#include <bit>

using namespace facetmill;
using namespace facetmill::io::gltf;

namespace {

template <class T>
io::Span bytes_of(const std::vector<T>& numbers) {
    return std::as_bytes(std::span(numbers));
}

io::Bytes copy_of(io::Span bytes) { return {bytes.begin(), bytes.end()}; }

/// Words that climb, small numbers, floats of both signs and noise, 16 bytes each.
std::vector<std::uint32_t> mixed(std::size_t count) {
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = 0; i < count; ++i) {
        all.push_back((i * 300 & 0xFFFF) | (65535 - i % 9) << 16);
        all.push_back(i % 5 == 0 ? 1 : 0);
        all.push_back(std::bit_cast<std::uint32_t>(i % 2 == 0 ? 1.5F : -1.5F) + i % 3);
        all.push_back(static_cast<std::uint32_t>(hashed(7, i)));
    }
    return all;
}

} // namespace

TEST_CASE("what goes into an attribute stream comes out", "[io]") {
    for (const std::size_t count : {0, 1, 15, 16, 17, 255, 256, 257, 700})
        for (const std::size_t stride : {4, 8, 12, 16, 64, 256}) {
            INFO(count << " of " << stride);
            const auto numbers = mixed((count * stride + 15) / 16);
            const io::Span given = bytes_of(numbers).first(count * stride);
            const io::Bytes stream = encode_attribute_stream(given, count, stride);
            CHECK(is_attribute_stream_1(stream));
            CHECK(count <= most_elements_in_stream(stream.size(), stride));
            const auto again = decode_attribute_stream(stream, count, stride);
            REQUIRE(again);
            CHECK(*again == copy_of(given));
        }
    const std::vector<std::uint32_t> same(100000, 77);
    const io::Bytes stream = encode_attribute_stream(bytes_of(same), same.size(), 4);
    CHECK(stream.size() < 500);
    CHECK(same.size() <= most_elements_in_stream(stream.size(), 4));
}

TEST_CASE("attribute streams of meshoptimizer 1.2 are read, and ours of words are no larger", "[io]") {
    std::vector<std::uint16_t> words;
    for (std::uint32_t i = 0; i < 70; ++i)
        for (const std::uint32_t w : {300 * i, 65535 - 7 * i, i % 3, 0u})
            words.push_back(static_cast<std::uint16_t>(w));
    std::vector<float> powers, thirds;
    for (int i = 0; i < 40; ++i) {
        powers.push_back(static_cast<float>((i % 2 ? -1 : 1) * (1 << (i % 5))));
        thirds.push_back(static_cast<float>(i % 3 - 1) * 1.5F);
    }
    const std::vector<std::tuple<io::Bytes, std::size_t, const char*>> all = {
        {copy_of(bytes_of(words)), 8,
         "oZepAFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhYWFhY"
         "WFUBKqqqqqqqqqqqqqqqqqqqqqqgAACqAg3d3d3d3d3d3d3d3d3d3d3d3d3d3d3d3d3d3d3d3d3d3d3dAAAAAACqAQIjIjIj"
         "IjIjIjIjIjIjIjIjIjIjIjIjIjIjIjIjIjIjrrAAAAMDAAAAAAAAAAAAAAAAAAAAAP//AAAAAAEA"},
        {copy_of(bytes_of(powers)), 4,
         "oWkVFVVVVVVVVVVVVQAAFTd933f/A/z/A/z/A/zd933f/wP8/wP8/wP8/3fdAAAD/P8DAAAAAAAAAAAAAAAAAAAAAAAAAAAA"
         "gD8S"},
        {copy_of(bytes_of(thirds)), 4,
         "oWkVIoooooooooooogAAALZt/////////////9u2//////////////9tAP//////AAAAAAAAAAAAAAAAAAAAAAAAAAAAwL8i"}};
    for (const auto& [given, stride, text] : all) {
        const std::size_t count = given.size() / stride;
        const io::Bytes theirs = data_uri_bytes(std::string("data:;base64,") + text);
        const auto read = decode_attribute_stream(theirs, count, stride);
        REQUIRE(read);
        CHECK(*read == given);
        if (stride == 8) CHECK(encode_attribute_stream(given, count, stride).size() <= theirs.size());
    }
}

TEST_CASE("damaged attribute streams are told, whatever is damaged", "[io]") {
    const auto numbers = mixed(300);
    const io::Bytes stream = encode_attribute_stream(bytes_of(numbers), 300, 16);
    for (std::size_t length = 0; length < stream.size(); ++length)
        CHECK_FALSE(decode_attribute_stream(io::Span(stream).first(length), 300, 16));
    CHECK_FALSE(decode_attribute_stream(stream, 299, 16));
    CHECK_FALSE(decode_attribute_stream(stream, 5000, 16));
    io::Bytes mode = stream;
    mode.back() = std::byte{3};
    CHECK_FALSE(decode_attribute_stream(mode, 300, 16));
    mode.back() = std::byte{0x10};
    CHECK_FALSE(decode_attribute_stream(mode, 300, 16));
    for (std::uint64_t n = 0; n < 2000; ++n) { // it may give other numbers, but nothing worse
        io::Bytes broken = stream;
        for (std::uint64_t k = 0; k <= n % 4; ++k)
            broken[hashed(1, 8 * n + k) % broken.size()] = static_cast<std::byte>(hashed(2, 8 * n + k));
        const auto read = decode_attribute_stream(broken, 300, 16);
        CHECK((!read || read->size() == 4800));
    }
}
