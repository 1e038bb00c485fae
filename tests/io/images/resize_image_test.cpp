#include "io/images/resize_image.hpp"
#include "support/catch.hpp"

#include <cmath>

using namespace facetmill;
using io::PixelKind;

namespace {

using Pixel = std::array<int, 4>;

/// colour(x, y) for each pixel.
template <class Colour>
io::Pixels painted(std::size_t width, std::size_t height, Colour&& colour) {
    io::Pixels image{width, height, {}, false};
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            for (const int c : Pixel(colour(x, y))) image.rgba.push_back(static_cast<std::uint8_t>(c));
    return image;
}

Pixel pixel(const io::Pixels& image, std::size_t x, std::size_t y) {
    const std::uint8_t* p = &image.rgba[4 * (y * image.width + x)];
    return {p[0], p[1], p[2], p[3]};
}

} // namespace

TEST_CASE("black and white mix to half the light in colours, to half the number in numbers", "[io]") {
    const auto image = painted(64, 64, [](std::size_t x, std::size_t y) {
        const int c = (x + y) % 2 ? 255 : 0;
        return Pixel{c, c, c, 255};
    });
    // sRGB of 0.5 is 187.5; the ends of the filter touch the borders, so look in the middle.
    CHECK(pixel(io::resized_image(image, 8, 8, PixelKind::colours, false), 4, 4) ==
          Pixel{188, 188, 188, 255});
    CHECK(pixel(io::resized_image(image, 8, 8, PixelKind::numbers, false), 4, 4) ==
          Pixel{128, 128, 128, 255});
}

TEST_CASE("an image of one colour keeps it, and one of the same size all of its pixels", "[io]") {
    for (const auto kind : {PixelKind::colours, PixelKind::numbers}) {
        const auto plain = painted(37, 11, [](std::size_t, std::size_t) { return Pixel{200, 31, 4, 90}; });
        const auto small = io::resized_image(plain, 9, 5, kind, false);
        CHECK((small.width == 9 && small.height == 5 && small.rgba.size() == 180));
        for (std::size_t x = 0; x < 9; ++x) CHECK(pixel(small, x, 2) == Pixel{200, 31, 4, 90});
        const auto any = painted(16, 16, [](std::size_t x, std::size_t y) {
            return Pixel{int(x * 16), int(y * 15), int(x * y), int(255 - x)};
        });
        CHECK(io::resized_image(any, 16, 16, kind, false).rgba == any.rgba);
    }
}

TEST_CASE("normals are of length 1 after they were mixed", "[io]") {
    const auto ridged = painted(32, 32, [](std::size_t x, std::size_t) {
        return x % 2 ? Pixel{218, 128, 218, 255} : Pixel{37, 128, 218, 255}; // 45 degrees to either side
    });
    const auto small = io::resized_image(ridged, 8, 8, PixelKind::normals, false);
    const Pixel flat = pixel(small, 4, 4);
    CHECK(std::abs(flat[0] - 128) <= 1);
    CHECK(flat[2] == 255);
    // As numbers, it would be 45 degrees' height: too short.
    CHECK(pixel(io::resized_image(ridged, 8, 8, PixelKind::numbers, false), 4, 4)[2] == 218);
}

TEST_CASE("what cannot be seen does not colour what can", "[io]") {
    const auto leaf = painted(32, 32, [](std::size_t x, std::size_t) {
        return x % 2 ? Pixel{0, 200, 0, 255} : Pixel{255, 0, 0, 0};
    });
    const auto seen = pixel(io::resized_image(leaf, 8, 8, PixelKind::colours, true), 4, 4);
    CHECK((seen[0] == 0 && seen[1] == 200 && seen[2] == 0));
    CHECK((seen[3] == 127 || seen[3] == 128)); // the mean is 127.5
    CHECK(pixel(io::resized_image(leaf, 8, 8, PixelKind::colours, false), 4, 4)[0] > 150);
    // Fully transparent areas keep their colours, because renderers filter them.
    const auto clear = painted(32, 32, [](std::size_t, std::size_t) { return Pixel{9, 99, 199, 0}; });
    CHECK(pixel(io::resized_image(clear, 4, 4, PixelKind::colours, true), 2, 2) == Pixel{9, 99, 199, 0});
}

TEST_CASE("the filter is Lanczos's of three lobes", "[io]") {
    // Pillow's Image.resize((8, 1), LANCZOS) of the row x * x / 16, on one channel.
    const auto row = painted(64, 1, [](std::size_t x, std::size_t) {
        const int c = int(x * x / 16);
        return Pixel{c, c, c, 255};
    });
    const auto small = io::resized_image(row, 8, 1, PixelKind::numbers, false);
    std::vector<int> got;
    for (std::size_t x = 0; x < 8; ++x) got.push_back(pixel(small, x, 0)[0]);
    CHECK(got == std::vector<int>{1, 8, 24, 47, 79, 117, 166, 221});
}
