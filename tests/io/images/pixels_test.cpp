#include "io/images/pixels.hpp"
#include "io/images/png.hpp"
#include "support/catch.hpp"
#include "support/images.hpp"
#include "support/temporary.hpp"

#include <cstdio>
#include <jpeglib.h>

using namespace facetmill;
using namespace facetmill::test;

namespace {

using Rgba = std::vector<std::uint8_t>;

/// A ramp to the right: each pixel is brighter than the one before.
io::Pixels ramp(std::size_t width) {
    io::Pixels all{width, 1, {}};
    for (std::size_t x = 0; x < width; ++x)
        for (int c = 0; c < 4; ++c) all.rgba.push_back(c == 3 ? 255 : static_cast<std::uint8_t>(40 * x));
    return all;
}

/// A JPEG of one grey pixel.
io::Bytes grey_jpeg(unsigned char value) {
    jpeg_compress_struct state{};
    jpeg_error_mgr errors{};
    state.err = ::jpeg_std_error(&errors);
    ::jpeg_create_compress(&state);
    unsigned char* data = nullptr;
    unsigned long size = 0;
    ::jpeg_mem_dest(&state, &data, &size);
    state.image_width = state.image_height = 1;
    state.input_components = 1;
    state.in_color_space = JCS_GRAYSCALE;
    ::jpeg_set_defaults(&state);
    ::jpeg_start_compress(&state, TRUE);
    JSAMPROW row = &value;
    ::jpeg_write_scanlines(&state, &row, 1);
    ::jpeg_finish_compress(&state);
    ::jpeg_destroy_compress(&state);
    const auto* bytes = reinterpret_cast<const std::byte*>(data);
    const io::Bytes all(bytes, bytes + size);
    std::free(data);
    return all;
}

} // namespace

TEST_CASE("PNG and JPEG are decoded, and what is broken is none", "[io]") {
    CHECK(io::decoded_image(bytes_of(png_of(0, "\x40")))->rgba == Rgba{0x40, 0x40, 0x40, 255});
    CHECK(io::decoded_image(bytes_of(png_of(6, "\x01\x02\x03\x04")))->rgba == Rgba{1, 2, 3, 4});
    const io::Bytes jpeg = grey_jpeg(200);
    CHECK(io::decoded_image(jpeg)->rgba == Rgba{200, 200, 200, 255});
    const std::string png = red_png();
    for (const std::size_t n : {std::size_t{8}, std::size_t{20}, png.size() / 2})
        CHECK_FALSE(io::decoded_image(bytes_of(png).first(n)));
    CHECK_FALSE(io::decoded_image(io::Span(jpeg).first(20)));
    CHECK_FALSE(io::decoded_image(bytes_of("no image")));
}

TEST_CASE("channels of images are combined, small ones scaled", "[io]") {
    const io::Pixels two = ramp(2), four = ramp(4);
    const auto all =
        io::decoded_image(io::combined_image({io::Channel{&two, 0}, {&four, io::brightness}, {}, {}}));
    REQUIRE(all);
    CHECK(all->width == 4);
    CHECK(all->rgba == Rgba{0, 0, 255, 255, 0, 40, 255, 255, 40, 80, 255, 255, 40, 120, 255, 255});
    CHECK(io::is_grey(two));
    CHECK_FALSE(io::is_grey(*all));
}

TEST_CASE("the normals of a relief lean away from what is higher", "[io]") {
    const auto normals = io::decoded_image(io::normals_of_relief(ramp(4), 1));
    REQUIRE(normals);
    CHECK(normals->rgba[4] < 128);  // higher on the right: to the left
    CHECK(normals->rgba[5] == 128); // one row: nothing up or down
    CHECK(normals->rgba[12] > 128); // repeated at the border, where it falls
    io::Pixels upright = ramp(4);
    std::swap(upright.width, upright.height); // higher further down
    CHECK(io::decoded_image(io::normals_of_relief(upright, 1))->rgba[5] > 128);
    CHECK(io::decoded_image(io::normals_of_relief(upright, 0))->rgba[5] == 128);
}

TEST_CASE("a PNG of 16 bits, or with a gamma, keeps its numbers", "[io]") {
    const std::string grey("\x80\x80", 2), colour("\x10\x10\x80\x80\xff\xff\x40\x40", 8);
    for (const std::uint32_t gamma : {0U, 45455U, 100000U}) {
        CHECK(io::decoded_image(bytes_of(png_of(0, grey, 16, gamma)))->rgba == Rgba{128, 128, 128, 255});
        CHECK(io::decoded_image(bytes_of(png_of(6, colour, 16, gamma)))->rgba == Rgba{16, 128, 255, 64});
        CHECK(io::decoded_image(bytes_of(png_of(0, "\x40", 8, gamma)))->rgba == Rgba{64, 64, 64, 255});
    }
}

TEST_CASE("a WebP is decoded, and the size of an image read from its header", "[io]") {
    // Without loss: red, and half transparent (0, 64, 255).
    const std::string webp("\x52\x49\x46\x46\x20\x00\x00\x00\x57\x45\x42\x50\x56\x50\x38\x4c\x14\x00\x00\x00"
                           "\x2f\x01\x00\x00\x10\x0f\x30\x40\xfb\x3f\xff\x0f\xfc\x0f\x2d\x54\x20\xa2\xff\x01",
                           40);
    const auto image = io::decoded_image(bytes_of(webp));
    REQUIRE(image);
    CHECK(image->rgba == Rgba{255, 0, 0, 255, 0, 64, 255, 128});
    CHECK_FALSE(io::decoded_image(bytes_of(webp).first(30)));
    using Size = std::pair<std::size_t, std::size_t>;
    CHECK(io::image_size(bytes_of(webp)) == Size{2, 1});
    CHECK(io::image_size(grey_jpeg(7)) == Size{1, 1});
    CHECK(io::image_size(bytes_of(red_png())) == Size{1, 1});
    CHECK_FALSE(io::image_size(bytes_of("no image")));
}
