#include "io/encode_image.hpp"

#include "base/error.hpp"

#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <jpeglib.h>
#include <png.h>
#include <webp/encode.h>

namespace facetmill::io {

namespace {

[[noreturn]] void no_memory_for(const char* format) {
    throw out_of_memory(std::string("no memory to write an image as ") + format);
}

// --- PNG

struct PngWriter {
    png_structp state = ::png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, leave, ignore);
    png_infop info = state ? ::png_create_info_struct(state) : nullptr;
    Bytes out{};

    PngWriter() = default;
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;
    ~PngWriter() { ::png_destroy_write_struct(&state, &info); }

    [[noreturn]] static void leave(png_structp state, png_const_charp) { ::png_longjmp(state, 1); }
    static void ignore(png_structp, png_const_charp) {}
    static void append(png_structp png, png_bytep data, std::size_t count) {
        Bytes& out = static_cast<PngWriter*>(::png_get_io_ptr(png))->out;
        const auto* bytes = reinterpret_cast<const std::byte*>(data);
        try {
            out.insert(out.end(), bytes, bytes + count);
        } catch (const std::bad_alloc&) {
            ::png_error(png, "memory");
        }
    }
    static void flush(png_structp) {}
};

/// The pixels with as many channels as the colour type has.
std::vector<std::uint8_t> packed_channels(const Pixels& image, int colour_type) {
    const std::size_t colours = (colour_type & PNG_COLOR_MASK_COLOR) != 0 ? 3 : 1;
    const bool alpha = (colour_type & PNG_COLOR_MASK_ALPHA) != 0;
    std::vector<std::uint8_t> out;
    out.reserve(image.width * image.height * (colours + (alpha ? 1 : 0)));
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        out.insert(out.end(), &image.rgba[i], &image.rgba[i] + colours);
        if (alpha) out.push_back(image.rgba[i + 3]);
    }
    return out;
}

/// Nothing here may need a destructor when the library jumps.
bool write_png(PngWriter& writer, const Pixels& image, int colour_type,
               const std::vector<std::uint8_t>& channels) {
    if (setjmp(png_jmpbuf(writer.state)) != 0) return false;
    ::png_set_write_fn(writer.state, &writer, PngWriter::append, PngWriter::flush);
    ::png_set_IHDR(writer.state, writer.info, static_cast<png_uint_32>(image.width),
                   static_cast<png_uint_32>(image.height), 8, colour_type, PNG_INTERLACE_NONE,
                   PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    ::png_set_filter(writer.state, PNG_FILTER_TYPE_BASE, PNG_ALL_FILTERS);
    ::png_set_compression_level(writer.state, 9);
    ::png_write_info(writer.state, writer.info);
    const std::size_t row = channels.size() / image.height;
    for (std::size_t y = 0; y < image.height; ++y) ::png_write_row(writer.state, &channels[y * row]);
    ::png_write_end(writer.state, nullptr);
    return true;
}

// --- JPEG

struct JpegWriter {
    jpeg_compress_struct state{};
    jpeg_error_mgr errors{}; // the first that the library sees of what follows
    std::jmp_buf back{};
    unsigned char* bytes = nullptr;
    unsigned long size = 0;

    JpegWriter() = default;
    JpegWriter(const JpegWriter&) = delete;
    JpegWriter& operator=(const JpegWriter&) = delete;
    ~JpegWriter() {
        ::jpeg_destroy_compress(&state);
        std::free(bytes);
    }
    [[noreturn]] static void leave(j_common_ptr state) {
        std::longjmp(static_cast<JpegWriter*>(state->client_data)->back, 1);
    }
};

/// row: a buffer for one row of grey.
bool write_jpeg(JpegWriter& writer, const Pixels& image, const LossSettings& settings, bool grey,
                std::vector<std::uint8_t>& row) {
    jpeg_compress_struct& state = writer.state;
    state.err = ::jpeg_std_error(&writer.errors);
    writer.errors.error_exit = JpegWriter::leave;
    writer.errors.output_message = [](j_common_ptr) {};
    state.client_data = &writer;
    if (setjmp(writer.back) != 0) return false;
    ::jpeg_create_compress(&state);
    ::jpeg_mem_dest(&state, &writer.bytes, &writer.size);
    state.image_width = static_cast<JDIMENSION>(image.width);
    state.image_height = static_cast<JDIMENSION>(image.height);
    state.input_components = grey ? 1 : 4;
    state.in_color_space = grey ? JCS_GRAYSCALE : JCS_EXT_RGBX;
    ::jpeg_set_defaults(&state);
    ::jpeg_set_quality(&state, settings.quality, TRUE);
    state.dct_method = JDCT_ISLOW; // integers: the same on every processor
    state.optimize_coding = TRUE;
    if (settings.as_numbers) {
        state.comp_info[0].h_samp_factor = 1;
        state.comp_info[0].v_samp_factor = 1;
    }
    ::jpeg_simple_progression(&state);
    ::jpeg_start_compress(&state, TRUE);
    for (std::size_t y = 0; y < image.height; ++y) {
        const std::uint8_t* from = &image.rgba[4 * image.width * y];
        for (std::size_t x = 0; grey && x < image.width; ++x) row[x] = from[4 * x];
        JSAMPROW line = grey ? row.data() : const_cast<JSAMPROW>(from);
        ::jpeg_write_scanlines(&state, &line, 1);
    }
    ::jpeg_finish_compress(&state);
    return true;
}

Bytes bytes_from(const std::uint8_t* data, std::size_t size) {
    const auto* bytes = reinterpret_cast<const std::byte*>(data);
    return {bytes, bytes + size};
}

// --- WebP

struct WebpWriter {
    WebPPicture picture{};
    WebPMemoryWriter memory{};

    WebpWriter() { ::WebPMemoryWriterInit(&memory); }
    WebpWriter(const WebpWriter&) = delete;
    WebpWriter& operator=(const WebpWriter&) = delete;
    ~WebpWriter() {
        ::WebPPictureFree(&picture);
        ::WebPMemoryWriterClear(&memory);
    }
};

} // namespace

bool is_opaque(const Pixels& image) {
    for (std::size_t i = 3; i < image.rgba.size(); i += 4)
        if (image.rgba[i] != 255) return false;
    return true;
}

Bytes encoded_png(const Pixels& image) {
    PngWriter writer;
    const int colour_type =
        (is_grey(image) ? 0 : PNG_COLOR_MASK_COLOR) | (is_opaque(image) ? 0 : PNG_COLOR_MASK_ALPHA);
    const std::vector<std::uint8_t> channels = packed_channels(image, colour_type);
    if (!writer.info || !write_png(writer, image, colour_type, channels)) no_memory_for("PNG");
    return std::move(writer.out);
}

Bytes encoded_jpeg(const Pixels& image, const LossSettings& settings) {
    JpegWriter writer;
    std::vector<std::uint8_t> row(image.width);
    if (!write_jpeg(writer, image, settings, is_grey(image), row)) no_memory_for("JPEG");
    return bytes_from(writer.bytes, writer.size);
}

Bytes encoded_webp(const Pixels& image, const LossSettings& settings) {
    WebpWriter writer;
    WebPConfig config;
    // The effort of 6 takes twice the time of 5 for a hundredth of the bytes.
    const bool ready =
        ::WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, static_cast<float>(settings.quality)) != 0 &&
        ::WebPPictureInit(&writer.picture) != 0;
    if (!ready) no_memory_for("WebP");
    config.method = 5;
    config.lossless = settings.lossless;
    if (settings.lossless) config.quality = 75; // of the search, not of the image
    config.exact = 1;
    config.use_sharp_yuv = settings.as_numbers;
    writer.picture.use_argb = settings.lossless || settings.as_numbers; // not halved while it is read
    writer.picture.width = static_cast<int>(image.width);
    writer.picture.height = static_cast<int>(image.height);
    writer.picture.writer = ::WebPMemoryWrite;
    writer.picture.custom_ptr = &writer.memory;
    const int stride = 4 * writer.picture.width;
    const bool whole = ::WebPPictureImportRGBA(&writer.picture, image.rgba.data(), stride) != 0 &&
                       ::WebPEncode(&config, &writer.picture) != 0;
    if (!whole) no_memory_for("WebP");
    return bytes_from(writer.memory.mem, writer.memory.size);
}

} // namespace facetmill::io
