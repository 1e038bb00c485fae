#include "io/images/pixels.hpp"

#include "base/math/vec.hpp"
#include "io/images/avif.hpp"
#include "io/images/image_files.hpp"
#include "io/images/png.hpp"

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <jpeglib.h>
#include <png.h>
#include <webp/decode.h>

namespace facetmill::io {

namespace {

bool too_large(std::size_t width, std::size_t height) {
    return width == 0 || height == 0 || width > max_pixels / height;
}

/// The state of reading a PNG. libpng's simplified interface would apply gAMA and treat 16 bits as linear,
/// so it is not used.
struct PngReader {
    png_structp state = ::png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, leave, ignore);
    png_infop info = state ? ::png_create_info_struct(state) : nullptr;
    Span rest;

    explicit PngReader(Span bytes) : rest(bytes) {}
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
    ~PngReader() { ::png_destroy_read_struct(&state, &info, nullptr); }

    [[noreturn]] static void leave(png_structp state, png_const_charp) { ::png_longjmp(state, 1); }
    static void ignore(png_structp, png_const_charp) {}
    static void next(png_structp state, png_bytep to, std::size_t count) {
        Span& rest = static_cast<PngReader*>(::png_get_io_ptr(state))->rest;
        if (count > rest.size()) ::png_error(state, "cut short");
        std::memcpy(to, rest.data(), count);
        rest = rest.subspan(count);
    }
};

/// Converts everything to 8 bits of red, green, blue and alpha, without gamma correction.
void read_png_rows(PngReader& reader, Pixels& pixels) {
    const png_structp png = reader.state;
    ::png_set_expand(png); // expands palettes, fewer than 8 bits, and a transparent colour
    ::png_set_scale_16(png);
    ::png_set_gray_to_rgb(png);
    ::png_set_add_alpha(png, 255, PNG_FILLER_AFTER);
    const int passes = ::png_set_interlace_handling(png);
    ::png_read_update_info(png, reader.info);
    for (int pass = 0; pass < passes; ++pass)
        for (std::size_t y = 0; y < pixels.height; ++y)
            ::png_read_row(png, &pixels.rgba[4 * pixels.width * y], nullptr);
}

/// Reads into pixels, which the caller owns. The library may jump out, so no local may need a destructor.
/// header: reads only the size.
bool read_png(PngReader& reader, bool header, Pixels& pixels) {
    if (setjmp(png_jmpbuf(reader.state)) != 0) return false;
    ::png_set_read_fn(reader.state, &reader, PngReader::next);
    ::png_read_info(reader.state, reader.info);
    pixels.width = ::png_get_image_width(reader.state, reader.info);
    pixels.height = ::png_get_image_height(reader.state, reader.info);
    if (header) return true;
    if (too_large(pixels.width, pixels.height)) return false;
    pixels.rgba.resize(4 * pixels.width * pixels.height);
    read_png_rows(reader, pixels);
    return true;
}

std::optional<Pixels> decoded_png(Span bytes, bool header) {
    PngReader reader(bytes);
    Pixels pixels;
    if (!reader.info || !read_png(reader, header, pixels)) return {};
    return pixels;
}

/// libjpeg's error handler for broken images: it jumps back to the start of reading.
struct JpegErrors {
    jpeg_error_mgr manager;
    std::jmp_buf back;
};

[[noreturn]] void leave_jpeg(j_common_ptr state) {
    std::longjmp(reinterpret_cast<JpegErrors*>(state->err)->back, 1); // the manager is its first member
}

/// Stops at an image with more scans than encoders make.
void limit_scans(j_common_ptr state) {
    constexpr int most = 500;
    if (state->is_decompressor && reinterpret_cast<j_decompress_ptr>(state)->input_scan_number > most)
        leave_jpeg(state);
}

/// Reads a JPEG; see read_png.
bool read_jpeg(jpeg_decompress_struct& state, JpegErrors& errors, Span bytes, bool header, Pixels& pixels) {
    if (setjmp(errors.back) != 0) return false;
    ::jpeg_create_decompress(&state);
    ::jpeg_mem_src(&state, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    if (::jpeg_read_header(&state, TRUE) != JPEG_HEADER_OK) return false;
    pixels.width = state.image_width;
    pixels.height = state.image_height;
    if (header) return true;
    if (too_large(pixels.width, pixels.height)) return false;
    jpeg_progress_mgr progress{};
    progress.progress_monitor = limit_scans;
    state.progress = &progress;
    state.out_color_space = JCS_EXT_RGBA;
    state.dct_method = JDCT_ISLOW; // integer arithmetic gives the same result on every processor
    pixels.rgba.resize(4 * pixels.width * pixels.height);
    ::jpeg_start_decompress(&state);
    while (state.output_scanline < state.output_height) {
        JSAMPROW row = &pixels.rgba[4 * pixels.width * state.output_scanline];
        ::jpeg_read_scanlines(&state, &row, 1);
    }
    ::jpeg_finish_decompress(&state);
    pixels.damaged = errors.manager.num_warnings > 0;
    return true;
}

std::optional<Pixels> decoded_jpeg(Span bytes, bool header) {
    jpeg_decompress_struct state{};
    JpegErrors errors{};
    state.err = ::jpeg_std_error(&errors.manager);
    errors.manager.error_exit = leave_jpeg;
    errors.manager.output_message = [](j_common_ptr) {};
    Pixels pixels;
    const bool whole = read_jpeg(state, errors, bytes, header, pixels);
    ::jpeg_destroy_decompress(&state);
    if (!whole) return {};
    return pixels;
}

std::optional<Pixels> decoded_webp(Span bytes, bool header) {
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    int width = 0, height = 0;
    if (!::WebPGetInfo(data, bytes.size(), &width, &height) || width < 1 || height < 1) return {};
    Pixels pixels{static_cast<std::size_t>(width), static_cast<std::size_t>(height), {}, false};
    if (header) return pixels;
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

/// header: reads no pixels.
std::optional<Pixels> read_image_file(Span bytes, bool header) {
    const std::string type = media_type(bytes);
    if (type == "image/png") return decoded_png(bytes, header);
    if (type == "image/jpeg") return decoded_jpeg(bytes, header);
    if (type == "image/webp") return decoded_webp(bytes, header);
    if (type == "image/avif") return decoded_avif(bytes, header);
    return {};
}

} // namespace

std::optional<Pixels> decoded_image(Span bytes) { return read_image_file(bytes, false); }

std::optional<std::pair<std::size_t, std::size_t>> image_size(Span bytes) {
    const auto image = read_image_file(bytes, true);
    if (!image) return {};
    return std::pair{image->width, image->height};
}

bool is_grey(const Pixels& image) {
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
        if (image.rgba[i] != image.rgba[i + 1] || image.rgba[i] != image.rgba[i + 2]) return false;
    return true;
}

Bytes combined_image(const std::array<Channel, 4>& channels) {
    Pixels out{1, 1, {}, false};
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
    Pixels out{relief.width, relief.height, std::vector<std::uint8_t>(relief.rgba.size()), false};
    const auto height = [&](std::size_t x, std::size_t y) {
        const std::size_t at = (y % relief.height) * relief.width + x % relief.width;
        return brightness_of(&relief.rgba[4 * at]) / 255.0;
    };
    for (std::size_t y = 0; y < out.height; ++y)
        for (std::size_t x = 0; x < out.width; ++x) {
            // Image rows go down, but the texture's second axis points up.
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
