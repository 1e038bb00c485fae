#include "io/images/encode_image.hpp"

#include "base/error.hpp"
#include "io/images/image_files.hpp"

#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
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
    const std::size_t
        most; ///< stops as soon as the image has more bytes, because a larger result is not used
    bool too_many = false;

    explicit PngWriter(std::size_t bytes) : most(bytes) {}
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;
    ~PngWriter() { ::png_destroy_write_struct(&state, &info); }

    [[noreturn]] static void leave(png_structp state, png_const_charp) { ::png_longjmp(state, 1); }
    static void ignore(png_structp, png_const_charp) {}
    static void append(png_structp png, png_bytep data, std::size_t count) {
        PngWriter& writer = *static_cast<PngWriter*>(::png_get_io_ptr(png));
        Bytes& out = writer.out;
        writer.too_many = count > writer.most - out.size();
        if (writer.too_many) ::png_error(png, "size");
        const auto* bytes = reinterpret_cast<const std::byte*>(data);
        try {
            out.insert(out.end(), bytes, bytes + count);
        } catch (const std::bad_alloc&) {
            ::png_error(png, "memory");
        }
    }
    static void flush(png_structp) {}
};

/// The pixels, with the channels of the colour type.
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

/// The library may jump out of this function, so no local may need a destructor.
bool write_png(PngWriter& writer, const Pixels& image, int colour_type, int level,
               const std::vector<std::uint8_t>& channels, int bits = 8) {
    if (setjmp(png_jmpbuf(writer.state)) != 0) return false;
    ::png_set_write_fn(writer.state, &writer, PngWriter::append, PngWriter::flush);
    ::png_set_IHDR(writer.state, writer.info, static_cast<png_uint_32>(image.width),
                   static_cast<png_uint_32>(image.height), bits, colour_type, PNG_INTERLACE_NONE,
                   PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    ::png_set_filter(writer.state, PNG_FILTER_TYPE_BASE, PNG_ALL_FILTERS);
    ::png_set_compression_level(writer.state, level);
    ::png_write_info(writer.state, writer.info);
    const std::size_t row = channels.size() / image.height;
    for (std::size_t y = 0; y < image.height; ++y) ::png_write_row(writer.state, &channels[y * row]);
    ::png_write_end(writer.state, nullptr);
    return true;
}

// --- JPEG

struct JpegWriter {
    jpeg_compress_struct state{};
    jpeg_error_mgr errors{};
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
    state.dct_method = JDCT_ISLOW; // integer arithmetic gives the same bytes on every processor
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

// --- JPEG without loss

/// The output of a JPEG's coefficients.
struct JpegTarget {
    jpeg_compress_struct state{};
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
};

/// A JPEG whose coefficients are copied twice: with several scans and with a single scan.
struct JpegCopy {
    jpeg_decompress_struct from{};
    std::array<JpegTarget, 2> to{};
    jpeg_error_mgr from_errors{}, to_errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf back{};

    JpegCopy() = default;
    JpegCopy(const JpegCopy&) = delete;
    JpegCopy& operator=(const JpegCopy&) = delete;
    ~JpegCopy() {
        for (JpegTarget& target : to) ::jpeg_destroy_compress(&target.state);
        ::jpeg_destroy_decompress(&from);
        for (JpegTarget& target : to) std::free(target.bytes);
    }
    [[noreturn]] static void leave(j_common_ptr state) {
        std::longjmp(static_cast<JpegCopy*>(state->client_data)->back, 1);
    }
    static jpeg_error_mgr* quiet(jpeg_error_mgr& errors) {
        ::jpeg_std_error(&errors);
        errors.error_exit = leave;
        errors.output_message = [](j_common_ptr) {};
        return &errors;
    }
    /// Limits the number of scans. Encoders make fewer.
    static void limit_scans(j_common_ptr state) {
        constexpr int most = 500;
        if (state->is_decompressor && reinterpret_cast<j_decompress_ptr>(state)->input_scan_number > most)
            leave(state);
    }
};

/// Whether the library writes this marker (JFIF, Adobe) anyway.
bool writes_itself(const jpeg_compress_struct& to, const jpeg_marker_struct& marker) {
    const auto begins = [&](const char* text, std::size_t length) {
        return marker.data_length >= length && std::memcmp(marker.data, text, length) == 0;
    };
    return (to.write_JFIF_header && marker.marker == JPEG_APP0 && begins("JFIF", 5)) ||
           (to.write_Adobe_marker && marker.marker == JPEG_APP0 + 14 && begins("Adobe", 5));
}

/// Reads the coefficients; null if the file is broken. The library may jump out, so no local may need a
/// destructor.
jvirt_barray_ptr* read_coefficients(JpegCopy& copy, Span bytes) {
    copy.from.err = JpegCopy::quiet(copy.from_errors);
    copy.from.client_data = &copy;
    copy.progress.progress_monitor = JpegCopy::limit_scans;
    if (setjmp(copy.back) != 0) return nullptr;
    ::jpeg_create_decompress(&copy.from);
    ::jpeg_mem_src(&copy.from, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    ::jpeg_save_markers(&copy.from, JPEG_COM, 0xFFFF);
    for (int n = 0; n < 16; ++n) ::jpeg_save_markers(&copy.from, JPEG_APP0 + n, 0xFFFF);
    if (::jpeg_read_header(&copy.from, TRUE) != JPEG_HEADER_OK) return nullptr;
    copy.from.progress = &copy.progress;
    jvirt_barray_ptr* coefficients = ::jpeg_read_coefficients(&copy.from);
    return copy.from_errors.num_warnings > 0 ? nullptr : coefficients;
}

/// False if they cannot be written. The library may jump out, so no local may need a destructor.
bool write_coefficients(JpegCopy& copy, JpegTarget& target, jvirt_barray_ptr* coefficients,
                        bool progressive) {
    jpeg_compress_struct& to = target.state;
    to.err = JpegCopy::quiet(copy.to_errors);
    to.client_data = &copy;
    if (setjmp(copy.back) != 0) return false;
    ::jpeg_create_compress(&to);
    ::jpeg_copy_critical_parameters(&copy.from, &to);
    to.optimize_coding = TRUE;
    if (progressive) ::jpeg_simple_progression(&to);
    ::jpeg_mem_dest(&to, &target.bytes, &target.size);
    ::jpeg_write_coefficients(&to, coefficients);
    for (const jpeg_marker_struct* m = copy.from.marker_list; m; m = m->next)
        if (!writes_itself(to, *m)) ::jpeg_write_marker(&to, m->marker, m->data, m->data_length);
    ::jpeg_finish_compress(&to);
    return true;
}

Bytes repacked_jpeg(Span bytes) {
    JpegCopy copy;
    jvirt_barray_ptr* const coefficients = read_coefficients(copy, bytes);
    const JpegTarget* best = nullptr;
    for (JpegTarget& target : copy.to) {
        const bool progressive = &target == &copy.to.front();
        if (coefficients && write_coefficients(copy, target, coefficients, progressive) &&
            (!best || target.size < best->size))
            best = &target;
    }
    return best ? bytes_from(best->bytes, best->size) : Bytes{};
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

namespace {

constexpr int smallest = 9, quick = 4, fastest = 1; // zlib levels

/// Returns no bytes if the result would be larger than `most` bytes.
Bytes png_of_type(const Pixels& image, int colour_type, int level, std::size_t most = SIZE_MAX) {
    PngWriter writer(most);
    const std::vector<std::uint8_t> channels = packed_channels(image, colour_type);
    const bool whole = writer.info && write_png(writer, image, colour_type, level, channels);
    if (writer.too_many) return {};
    if (!whole) no_memory_for("PNG");
    return std::move(writer.out);
}

int alpha_type(const Pixels& image) { return is_opaque(image) ? 0 : PNG_COLOR_MASK_ALPHA; }

int type_of(const Pixels& image) { return (is_grey(image) ? 0 : PNG_COLOR_MASK_COLOR) | alpha_type(image); }

/// The PNG, or nothing if it is unlikely to be smaller than the given file. If the fastest level gives a
/// large image over one and a half times the given size, the slowest level seldom helps. This occurs for the
/// colours of a palette.
Bytes repacked_png(const Pixels& image, std::size_t given) {
    constexpr std::size_t large = std::size_t{1} << 20; // pixels of a large image
    const int type = type_of(image);
    if (image.width * image.height >= large && png_of_type(image, type, fastest, given + given / 2).empty())
        return {};
    return png_of_type(image, type, smallest, given);
}

} // namespace

Bytes encoded_png(const Pixels& image) { return png_of_type(image, type_of(image), smallest); }

Bytes encoded_png_quickly(const Pixels& image) { return png_of_type(image, type_of(image), quick); }

Bytes encoded_png_16(const std::vector<std::uint16_t>& levels, std::size_t side, std::size_t channels) {
    std::vector<std::uint8_t> bytes(2 * levels.size()); // big-endian, as in the file
    for (std::size_t i = 0; i < levels.size(); ++i) {
        bytes[2 * i] = static_cast<std::uint8_t>(levels[i] >> 8);
        bytes[2 * i + 1] = static_cast<std::uint8_t>(levels[i] & 0xFF);
    }
    PngWriter writer(SIZE_MAX);
    const Pixels frame{side, side, {}, false};
    const int type = channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB;
    if (!writer.info || !write_png(writer, frame, type, quick, bytes, 16)) no_memory_for("PNG");
    return std::move(writer.out);
}

Bytes encoded_png_in_colour(const Pixels& image) {
    return png_of_type(image, PNG_COLOR_MASK_COLOR | alpha_type(image), smallest);
}

Bytes repacked_image(Span bytes) {
    constexpr std::size_t depth_at = 24; // offset of the bit depth in a PNG's header
    const std::string type = media_type(bytes);
    const bool png = type == "image/png", jpeg = type == "image/jpeg";
    if ((!png && !jpeg) || bytes.size() <= depth_at) return {};
    if (png && bytes[depth_at] == std::byte{16}) return {};
    const std::optional<Pixels> image = decoded_image(bytes);
    if (!image || image->damaged) return {};
    Bytes out = jpeg ? repacked_jpeg(bytes) : repacked_png(*image, bytes.size());
    if (out.empty() || out.size() >= bytes.size()) return {};
    const std::optional<Pixels> again = decoded_image(out);
    if (!again || again->rgba != image->rgba) return {}; // a fault of the library changed pixels
    return out;
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
    // Method 6 takes twice the time of 5 for about 1 % fewer bytes.
    const bool ready =
        ::WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, static_cast<float>(settings.quality)) != 0 &&
        ::WebPPictureInit(&writer.picture) != 0;
    if (!ready) no_memory_for("WebP");
    config.method = 5;
    config.lossless = settings.lossless;
    if (settings.lossless) config.quality = 75; // the effort of the search, not the image quality
    config.exact = 1;
    config.use_sharp_yuv = settings.as_numbers;
    writer.picture.use_argb =
        settings.lossless || settings.as_numbers; // avoids chroma subsampling of the input
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
