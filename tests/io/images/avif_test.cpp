#include "io/images/avif.hpp"

#include "io/images/image_faults.hpp"
#include "io/images/image_files.hpp"
#include "support/catch.hpp"
#include "support/images.hpp"

#include <cstdlib>

using namespace facetmill;

namespace {

/// Soft colours, with alpha from 0 to 255 downwards.
io::Pixels soft(bool alpha) {
    io::Pixels image{40, 30, {}, false};
    for (std::size_t y = 0; y < image.height; ++y)
        for (std::size_t x = 0; x < image.width; ++x)
            for (const std::size_t c : {6 * x, 8 * y, 90 + x + y, alpha ? 8 * y : 255ul})
                image.rgba.push_back(static_cast<std::uint8_t>(c));
    return image;
}

} // namespace

TEST_CASE("AVIF files are known by their brands", "[io]") {
    using namespace std::string_view_literals;
    CHECK(io::media_type(io::bytes_of_text("\0\0\0\x14"
                                           "ftypavif\0\0\0\0mif1"sv)) == "image/avif");
    CHECK(io::media_type(io::bytes_of_text("\0\0\0\x18"
                                           "ftypmif1\0\0\0\0mif1avif"sv)) == "image/avif");
    CHECK(io::media_type(io::bytes_of_text("\0\0\0\x14"
                                           "ftypheic\0\0\0\0mif1"sv))
              .empty());
    CHECK(io::media_type(io::bytes_of_text("\0\0\0\x14"
                                           "ftypheic\0\0\0\0mif1avif"sv))
              .empty()); // beyond the box
    CHECK(io::suffix_of_image("image/avif") == ".avif");
}

TEST_CASE("AVIF images keep their pixels", "[io]") {
    if (!io::has_avif()) return;
    for (const bool alpha : {false, true}) {
        const io::Pixels image = soft(alpha);
        const io::Bytes exact = io::encoded_avif(image, {80, true, false});
        CHECK(io::media_type(exact) == "image/avif");
        CHECK(io::image_fault(exact).empty());
        CHECK(io::image_size(exact) == std::pair(image.width, image.height));
        const auto same = io::decoded_image(exact);
        REQUIRE(same);
        CHECK(same->rgba == image.rgba);
        for (const bool numbers : {false, true}) {
            const io::Bytes lossy = io::encoded_avif(image, {85, false, numbers});
            const auto near = io::decoded_image(lossy);
            REQUIRE(near);
            CHECK(test::farthest(*near, image) < 16);
            CHECK(lossy == io::encoded_avif(image, {85, false, numbers}));
        }
        CHECK(io::encoded_avif(image, {30, false, false}).size() < exact.size());
    }
}

TEST_CASE("truncated AVIF images are refused", "[io]") {
    if (!io::has_avif()) return;
    const io::Bytes whole = io::encoded_avif(soft(true), {60, false, false});
    for (std::size_t size = 0; size < whole.size(); size += 7) {
        const io::Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        CHECK_FALSE(io::decoded_image(part));
    }
    CHECK(io::image_fault(io::Bytes(whole.begin(), whole.end() - 1)) == "its data end early");
}
