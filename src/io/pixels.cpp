#include "io/pixels.hpp"

#include "base/vec.hpp"
#include "io/image_files.hpp"
#include "io/png.hpp"

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <jpeglib.h>
#include <png.h>
#include <webp/decode.h>

namespace facetmill::io {

namespace {

constexpr std::size_t max_pixels = std::size_t{1} << 26;

bool too_large(std::size_t width, std::size_t height) {
    return width == 0 || height == 0 || width > max_pixels / height;
}

std::optional<Pixels> decoded_png(Span bytes) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (!::png_image_begin_read_from_memory(&image, bytes.data(), bytes.size())) return {};
    Pixels pixels{image.width, image.height, {}};
    image.format = PNG_FORMAT_RGBA;
    if (too_large(pixels.width, pixels.height)) {
        ::png_image_free(&image);
        return {};
    }
    pixels.rgba.resize(PNG_IMAGE_SIZE(image));
    if (!::png_image_finish_read(&image, nullptr, pixels.rgba.data(), 0, nullptr)) return {};
    return pixels;
}

/// The library's way to say that an image is broken: it jumps back to where reading began.
struct JpegErrors {
    jpeg_error_mgr manager;
    std::jmp_buf back;
};

[[noreturn]] void leave_jpeg(j_common_ptr state) {
    std::longjmp(reinterpret_cast<JpegErrors*>(state->err)->back, 1); // the manager is its first member
}

/// Reads into pixels, which the caller holds: nothing here may need a destructor when the library jumps.
bool read_jpeg(jpeg_decompress_struct& state, JpegErrors& errors, Span bytes, Pixels& pixels) {
    if (setjmp(errors.back) != 0) return false;
    ::jpeg_create_decompress(&state);
    ::jpeg_mem_src(&state, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    if (::jpeg_read_header(&state, TRUE) != JPEG_HEADER_OK) return false;
    state.out_color_space = JCS_EXT_RGBA;
    state.dct_method = JDCT_ISLOW; // integers: the same on every processor
    if (too_large(state.image_width, state.image_height)) return false;
    pixels.width = state.image_width;
    pixels.height = state.image_height;
    pixels.rgba.resize(4 * pixels.width * pixels.height);
    ::jpeg_start_decompress(&state);
    while (state.output_scanline < state.output_height) {
        JSAMPROW row = &pixels.rgba[4 * pixels.width * state.output_scanline];
        ::jpeg_read_scanlines(&state, &row, 1);
    }
    ::jpeg_finish_decompress(&state);
    return true;
}

std::optional<Pixels> decoded_jpeg(Span bytes) {
    jpeg_decompress_struct state{};
    JpegErrors errors{};
    state.err = ::jpeg_std_error(&errors.manager);
    errors.manager.error_exit = leave_jpeg;
    errors.manager.output_message = [](j_common_ptr) {};
    Pixels pixels;
    const bool whole = read_jpeg(state, errors, bytes, pixels);
    ::jpeg_destroy_decompress(&state);
    if (!whole) return {};
    return pixels;
}

std::optional<Pixels> decoded_webp(Span bytes) {
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    int width = 0, height = 0;
    if (!::WebPGetInfo(data, bytes.size(), &width, &height) || width < 1 || height < 1) return {};
    Pixels pixels{static_cast<std::size_t>(width), static_cast<std::size_t>(height), {}};
    if (too_large(pixels.width, pixels.height)) return {};
    pixels.rgba.resize(4 * pixels.width * pixels.height);
    if (!::WebPDecodeRGBAInto(data, bytes.size(), pixels.rgba.data(), pixels.rgba.size(), 4 * width))
        return {};
    return pixels;
}

std::uint8_t brightness_of(const std::uint8_t* p) {
    return static_cast<std::uint8_t>((299 * p[0] + 587 * p[1] + 114 * p[2] + 500) / 1000);
}

Bytes png_of(Pixels pixels) {
    Picture picture;
    picture.width = static_cast<int>(pixels.width);
    picture.height = static_cast<int>(pixels.height);
    picture.rgba = std::move(pixels.rgba);
    return png(picture);
}

} // namespace

std::optional<Pixels> decoded_image(Span bytes) {
    const std::string type = media_type(bytes);
    if (type == "image/png") return decoded_png(bytes);
    if (type == "image/jpeg") return decoded_jpeg(bytes);
    if (type == "image/webp") return decoded_webp(bytes);
    return {};
}

bool is_grey(const Pixels& image) {
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
        if (image.rgba[i] != image.rgba[i + 1] || image.rgba[i] != image.rgba[i + 2]) return false;
    return true;
}

Bytes combined_image(const std::array<Channel, 4>& channels) {
    Pixels out{1, 1, {}};
    for (const Channel& c : channels) {
        if (!c.image) continue;
        out.width = std::max(out.width, c.image->width);
        out.height = std::max(out.height, c.image->height);
    }
    out.rgba.resize(4 * out.width * out.height);
    for (std::size_t y = 0; y < out.height; ++y)
        for (std::size_t x = 0; x < out.width; ++x)
            for (std::size_t i = 0; i < 4; ++i) {
                const Channel& c = channels[i];
                const std::uint8_t* from = c.image ? c.image->at(x, y, out.width, out.height) : nullptr;
                out.rgba[4 * (y * out.width + x) + i] = !from                     ? c.number
                                                        : c.channel == brightness ? brightness_of(from)
                                                                                  : from[c.channel];
            }
    return png_of(std::move(out));
}

Bytes normals_of_relief(const Pixels& relief, double strength) {
    Pixels out{relief.width, relief.height, std::vector<std::uint8_t>(relief.rgba.size())};
    const auto height = [&](std::size_t x, std::size_t y) {
        const std::size_t at = (y % relief.height) * relief.width + x % relief.width;
        return brightness_of(&relief.rgba[4 * at]) / 255.0;
    };
    for (std::size_t y = 0; y < out.height; ++y)
        for (std::size_t x = 0; x < out.width; ++x) {
            // Rows go down and the texture's second axis up.
            const Vec3 n = normalised({strength * (height(x + out.width - 1, y) - height(x + 1, y)),
                                       strength * (height(x, y + 1) - height(x, y + out.height - 1)), 1});
            std::uint8_t* to = &out.rgba[4 * (y * out.width + x)];
            for (std::size_t c = 0; c < 3; ++c)
                to[c] = static_cast<std::uint8_t>(std::floor((n[c] + 1) / 2 * 255 + 0.5));
            to[3] = 255;
        }
    return png_of(std::move(out));
}

} // namespace facetmill::io
