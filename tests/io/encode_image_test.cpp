#include "io/encode_image.hpp"
#include "io/image_files.hpp"
#include "support/catch.hpp"

#include <cstdlib>

using namespace facetmill;

namespace {

/// Soft colours, with alpha from 0 to 255 to the right where that is asked for.
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

int farthest(const io::Pixels& a, const io::Pixels& b) {
    REQUIRE(a.rgba.size() == b.rgba.size());
    int most = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) most = std::max(most, std::abs(a.rgba[i] - b.rgba[i]));
    return most;
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
    const auto apart = [&](const io::Bytes& bytes) { return farthest(*io::decoded_image(bytes), image); };
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
