#include "io/images/image_faults.hpp"
#include "support/catch.hpp"
#include "support/images.hpp"

#include "io/images/encode_image.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

std::string fault(const std::string& bytes) { return io::image_fault(io::bytes_of_text(bytes)); }

std::string zeros(std::size_t count) { return std::string(count, '\0'); }

/// A JPEG of one pixel, with a segment before the others.
std::string jpeg(const std::string& segment = {}) {
    const io::Bytes bytes = io::encoded_jpeg({1, 1, {200, 200, 200, 255}}, {});
    return std::string(io::as_text(bytes)).insert(2, segment);
}

/// A KTX2 of one level of four bytes.
std::string ktx2() {
    std::string bytes("\xabKTX 20\xbb\r\n\x1a\n", 12);
    bytes += zeros(104 - 12);
    bytes[20] = bytes[24] = bytes[40] = 1; // width, height, levels
    bytes[80] = 104;                       // where the level is, and its bytes
    bytes[88] = 4;
    return bytes + zeros(4);
}

} // namespace

TEST_CASE("images that are whole have no fault", "[io]") {
    CHECK(fault(red_png()).empty());
    CHECK(fault(red_png() + "what follows the end is nobody's").empty());
    CHECK(fault(jpeg()).empty());
    CHECK(fault(jpeg() + zeros(3)).empty()); // cameras pad
    CHECK(fault(ktx2()).empty());
    CHECK(fault("DDS " + zeros(124)).empty());
}

TEST_CASE("images that are cut short are told, wherever", "[io]") {
    for (const std::string& image : {red_png(), ktx2()})
        for (std::size_t n = 16; n < image.size(); ++n) {
            INFO(n << " of " << image.size());
            CHECK_FALSE(fault(image.substr(0, n)).empty());
        }
    CHECK(fault(red_png().substr(0, red_png().size() - 1)) == "its data end early");
    CHECK(fault(jpeg().substr(0, jpeg().size() - 2)) == "its data end early");
    CHECK(fault(jpeg().substr(0, 40)) == "its header is broken");
    CHECK(fault("DDS " + zeros(123)) == "its data end early");
    const std::string webp("\x52\x49\x46\x46\x20\x00\x00\x00\x57\x45\x42\x50\x56\x50\x38\x4c\x14\x00\x00\x00"
                           "\x2f\x01\x00\x00\x10\x0f\x30\x40\xfb\x3f\xff\x0f\xfc\x0f\x2d\x54\x20\xa2\xff\x01",
                           40);
    CHECK(fault(webp).empty());
    CHECK_FALSE(fault(webp.substr(0, 39)).empty());
}

TEST_CASE("the end of a thumbnail is not that of its JPEG", "[io]") {
    const std::string thumbnail("\xff\xe1\x00\x06\xff\xd8\xff\xd9", 8); // as EXIF holds them
    CHECK(fault(jpeg(thumbnail)).empty());
    CHECK(fault(jpeg(thumbnail).substr(0, jpeg(thumbnail).size() - 2)) == "its data end early");
}

TEST_CASE("images without a header that can be true are told", "[io]") {
    CHECK(fault("") == "it is empty");
    CHECK(fault("no image") == "its kind is unknown");
    std::string png = red_png();
    png[16 + 3] = 0; // the width: its checksum does not hold, either
    CHECK(fault(png) == "its header is broken");
    CHECK(fault(png_of_rows(0, 1, 8, 2, "")) == "its header is broken");
    std::string flat = ktx2();
    flat[20] = 0;
    CHECK(fault(flat) == "its header is broken");
}
