#include "io/images/encode_image.hpp"

#include "base/math/random.hpp"
#include "io/images/image_files.hpp"
#include "support/catch.hpp"
#include "support/images.hpp"

#include <cstdlib>
#include <span>

using namespace facetmill;

namespace {

/// Soft colours, optionally with alpha from 0 to 255 to the right.
io::Pixels soft(bool alpha, bool grey) {
    io::Pixels image{48, 32, {}, false};
    for (std::size_t y = 0; y < image.height; ++y)
        for (std::size_t x = 0; x < image.width; ++x) {
            const auto at = [&](std::size_t n) { return static_cast<std::uint8_t>(n); };
            image.rgba.insert(image.rgba.end(), {at(5 * x), at(grey ? 5 * x : 7 * y), at(grey ? 5 * x : 90),
                                                 at(alpha ? 5 * x : 255)});
        }
    return image;
}

/// Files of others: a JPEG with the tables of the standard and a comment, a PNG that is not compressed.
const char* const wasteful_jpeg =
    "/9j/4AAQSkZJRgABAQAAAQABAAD//gAObWFkZSBieSBoYW5k/9sAQwAKBwcIBwYKCAgICwoKCw4YEA4NDQ4dFRYRGCMfJSQiHyIh"
    "Jis3LyYpNCkhIjBBMTQ5Oz4+PiUuRElDPEg3PT47/9sAQwEKCwsODQ4cEBAcOygiKDs7Ozs7Ozs7Ozs7Ozs7Ozs7Ozs7Ozs7Ozs7"
    "Ozs7Ozs7Ozs7Ozs7Ozs7Ozs7Ozs7Ozs7/8AAEQgAIAAgAwEiAAIRAQMRAf/EAB8AAAEFAQEBAQEBAAAAAAAAAAABAgMEBQYHCAkK"
    "C//EALUQAAIBAwMCBAMFBQQEAAABfQECAwAEEQUSITFBBhNRYQcicRQygZGhCCNCscEVUtHwJDNicoIJChYXGBkaJSYnKCkqNDU2"
    "Nzg5OkNERUZHSElKU1RVVldYWVpjZGVmZ2hpanN0dXZ3eHl6g4SFhoeIiYqSk5SVlpeYmZqio6Slpqeoqaqys7S1tre4ubrCw8TF"
    "xsfIycrS09TV1tfY2drh4uPk5ebn6Onq8fLz9PX29/j5+v/EAB8BAAMBAQEBAQEBAQEAAAAAAAABAgMEBQYHCAkKC//EALURAAIB"
    "AgQEAwQHBQQEAAECdwABAgMRBAUhMQYSQVEHYXETIjKBCBRCkaGxwQkjM1LwFWJy0QoWJDThJfEXGBkaJicoKSo1Njc4OTpDREVG"
    "R0hJSlNUVVZXWFlaY2RlZmdoaWpzdHV2d3h5eoKDhIWGh4iJipKTlJWWl5iZmqKjpKWmp6ipqrKztLW2t7i5usLDxMXGx8jJytLT"
    "1NXW19jZ2uLj5OXm5+jp6vLz9PX29/j5+v/aAAwDAQACEQMRAD8A8wjtParUdp7Vox2ntVmO09q9GeIOfD4oz47T2qzHae1aMdp7"
    "VajtPauSeIPoMPihkdp7VajtPatCO09qtR2ntXmTxB+c4fFGdHae1Wo7T2rRjtParMdp7VyzxB9Bh8Uf/9k=";
const char* const wasteful_png =
    "iVBORw0KGgoAAAANSUhEUgAAABAAAAAQCAIAAACQkWg2AAADG0lEQVR4AQEQA+/8AQMEWgkAAAsAAAoAAAoAAAoAAAoAAAoAAAoA"
    "AAoAAAoAAAoAAAoAAAoAAAoAAAkAAAQADQAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAEAA8A"
    "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAABAAOAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"
    "AAAAAAAAAAAAAAAAAAAAAAAAAAQADgAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAEAA4AAAAA"
    "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAABAAOAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"
    "AAAAAAAAAAAAAAAAAAAAAAQADgAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAEAA4AAAAAAAAA"
    "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAABAAOAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"
    "AAAAAAAAAAAAAAAAAAQADgAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAEAA4AAAAAAAAAAAAA"
    "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAABAAOAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"
    "AAAAAAAAAAAAAAQADgAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAEAA4AAAAAAAAAAAAAAAAA"
    "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAABAANAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"
    "AAAAAAAAAIOUAgUaSOqOAAAAAElFTkSuQmCC";

io::Bytes from_base64(std::string_view text) {
    static constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    io::Bytes out;
    std::uint32_t bits = 0, count = 0;
    for (const char c : text) {
        if (c == '=') break;
        bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
        count += 6;
        if (count < 8) continue;
        count -= 8;
        out.push_back(static_cast<std::byte>(bits >> count & 255));
    }
    return out;
}

/// A PNG of two colours with a bit of a palette for each of 1024 x 1024 pixels.
io::Bytes palette_png(bool (*second)(std::size_t pixel), int level) {
    constexpr std::uint32_t side = 1024;
    std::string rows;
    for (std::size_t pixel = 0; pixel < std::size_t{side} * side; pixel += 8) {
        if (pixel % side == 0) rows += '\0'; // no filter
        int bits = 0;
        for (std::size_t i = 0; i < 8; ++i) bits = bits << 1 | int(second(pixel + i));
        rows += static_cast<char>(bits);
    }
    const std::string palette = test::png_chunk("PLTE", std::string("\x0a\x1e\x5a\xc8\x1e\x07", 6));
    const std::string text = test::png_of_rows(side, side, 1, 3, rows, level, palette);
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

} // namespace

TEST_CASE("a PNG and a lossless WebP have the pixels that they are made of", "[io]") {
    for (const bool alpha : {false, true})
        for (const bool grey : {false, true}) {
            const io::Pixels image = soft(alpha, grey);
            const io::Bytes png = io::encoded_png(image);
            CHECK(io::decoded_image(png)->rgba == image.rgba);
            const auto colours = io::image_colours(png);
            REQUIRE(colours);
            CHECK((colours->grey == grey && colours->alpha == alpha));
            const io::Bytes webp = io::encoded_webp(image, {.lossless = true});
            CHECK(io::media_type(webp) == "image/webp");
            CHECK(io::decoded_image(webp)->rgba == image.rgba);
        }
}

TEST_CASE("JPEG and WebP are near to the pixels, by quality", "[io]") {
    const io::Pixels image = soft(false, false);
    const auto apart = [&](const io::Bytes& bytes) {
        return test::farthest(*io::decoded_image(bytes), image);
    };
    CHECK(apart(io::encoded_jpeg(image, {.quality = 95, .as_numbers = true})) <= 6);
    CHECK(apart(io::encoded_webp(image, {.quality = 95, .as_numbers = true})) <= 16);
    CHECK(io::encoded_jpeg(image, {.quality = 30}).size() < io::encoded_jpeg(image, {.quality = 95}).size());
    CHECK(io::encoded_webp(image, {.quality = 30}).size() < io::encoded_webp(image, {.quality = 95}).size());
    const auto grey = io::image_colours(io::encoded_jpeg(soft(false, true), {}));
    REQUIRE(grey);
    CHECK(grey->grey);
}

TEST_CASE("a JPEG that ends early is told apart from a whole one", "[io]") {
    io::Bytes bytes = io::encoded_jpeg(soft(false, false), {});
    CHECK_FALSE(io::decoded_image(bytes)->damaged);
    bytes.resize(bytes.size() / 2);
    const auto cut = io::decoded_image(bytes);
    REQUIRE(cut);
    CHECK(cut->damaged);
}

TEST_CASE("images are packed anew with the same pixels, or not at all", "[io]") {
    for (const char* text : {wasteful_jpeg, wasteful_png}) {
        const io::Bytes given = from_base64(text), packed = io::repacked_image(given);
        REQUIRE_FALSE(packed.empty());
        CHECK(packed.size() < given.size());
        CHECK(io::media_type(packed) == io::media_type(given));
        CHECK(io::decoded_image(packed)->rgba == io::decoded_image(given)->rgba);
        CHECK(io::repacked_image(packed).empty()); // no further gain
        // Broken images stay unchanged.
        CHECK(io::repacked_image(io::Span(given).first(given.size() * 2 / 3)).empty());
        CHECK(io::repacked_image(io::Span(given).first(20)).empty());
    }
    const io::Bytes jpeg = io::repacked_image(from_base64(wasteful_jpeg));
    const std::string_view said(reinterpret_cast<const char*>(jpeg.data()), jpeg.size());
    CHECK(said.find("made by hand") != std::string_view::npos);
    CHECK(io::repacked_image(io::encoded_webp(soft(false, false), {})).empty());
    io::Bytes deep = from_base64(wasteful_png);
    deep[24] = std::byte{16}; // bits a channel
    CHECK(io::repacked_image(deep).empty());
}

TEST_CASE("a large PNG of a palette is packed anew as colours only where it is wasteful", "[io]") {
    const io::Bytes noise = palette_png([](std::size_t pixel) { return (hashed(5, pixel) & 1) != 0; }, 9);
    REQUIRE(io::decoded_image(noise));
    CHECK(io::repacked_image(noise).empty());
    // Four patterns of 64 pixels, in any order. They need fewer bytes at the slowest level, but over half as
    // much again at the fastest. So the slowest level is not tried.
    const io::Bytes patterns = palette_png(
        [](std::size_t pixel) { return (hashed(hashed(7, pixel / 64) % 4, pixel % 64) & 1) != 0; }, 0);
    CHECK(io::encoded_png(*io::decoded_image(patterns)).size() < patterns.size() / 2);
    CHECK(io::repacked_image(patterns).empty());
    const io::Bytes stored = palette_png([](std::size_t pixel) { return pixel % 1024 > 300; }, 0);
    const io::Bytes packed = io::repacked_image(stored);
    CHECK(packed == io::encoded_png(*io::decoded_image(stored)));
    CHECK(packed.size() < stored.size() / 2);
}
