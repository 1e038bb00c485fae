#include "support/catch.hpp"

#include "io/images/pixels.hpp"
#include "io/images/png.hpp"

#include <zlib.h>

using namespace facetmill;

namespace {

std::uint32_t number(const io::Bytes& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
    return value;
}

} // namespace

TEST_CASE("base64 as RFC 4648 has it", "[io]") {
    const auto encoded = [](std::string_view text) { return io::base64(std::as_bytes(std::span(text))); };
    CHECK(encoded("") == "");
    CHECK(encoded("f") == "Zg==");
    CHECK(encoded("fo") == "Zm8=");
    CHECK(encoded("foo") == "Zm9v");
    CHECK(encoded("foobar") == "Zm9vYmFy");
    CHECK(encoded("\xff\xfe\xfd") == "//79");
}

TEST_CASE("a PNG holds its pixels", "[io]") {
    Picture picture{3, 2, {}};
    for (int i = 0; i < 24; ++i) picture.rgba.push_back(static_cast<std::uint8_t>(i * 37));
    const io::Bytes file = io::png(picture);
    REQUIRE(file.size() > 57);
    CHECK(io::as_text(file).substr(1, 3) == "PNG");
    CHECK(number(file, 16) == 3);
    CHECK(number(file, 20) == 2);

    std::vector<Bytef> rows(2 * 13);
    for (std::size_t at = 8; at < file.size();) {
        const std::uint32_t size = number(file, at);
        const auto* data = reinterpret_cast<const Bytef*>(file.data() + at + 8);
        CHECK(::crc32(0, data - 4, size + 4) == number(file, at + 8 + size));
        uLongf room = rows.size();
        if (io::as_text(file).substr(at + 4, 4) == "IDAT") {
            REQUIRE(::uncompress(rows.data(), &room, data, size) == Z_OK);
            CHECK(room == rows.size());
        }
        at += size + 12;
    }
    for (std::size_t y = 0; y < 2; ++y) {
        CHECK(rows[13 * y] == 1);
        for (std::size_t i = 0; i < 12; ++i) {
            if (i >= 4)
                rows[13 * y + 1 + i] = static_cast<Bytef>(rows[13 * y + 1 + i] + rows[13 * y + i - 3]);
            CHECK(rows[13 * y + 1 + i] == picture.rgba[12 * y + i]);
        }
    }
}

TEST_CASE("a PNG made fast has the same pixels", "[io]") {
    Picture picture{60, 40, {}};
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 60; ++x)
            for (const int value : {4 * x, 6 * y, x * y % 251, x < 30 ? 0 : 255 - y})
                picture.rgba.push_back(static_cast<std::uint8_t>(value));
    const io::Bytes fast = io::png(picture, io::PngEffort::fast);
    CHECK(fast != io::png(picture));
    const auto pixels = io::decoded_image(fast);
    REQUIRE(pixels);
    CHECK(pixels->rgba == picture.rgba);
}
