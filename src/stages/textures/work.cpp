#include "stages/textures/work.hpp"

#include "io/images/avif.hpp"
#include "io/images/encode_image.hpp"
#include "io/images/image_files.hpp"
#include "io/images/ktx_workers.hpp"
#include "io/images/resize_image.hpp"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace facetmill::textures_stage {

namespace {

using io::Pixels;

constexpr std::size_t block = 4; ///< KTX2 sides in glTF are multiples of this (KHR_texture_basisu)

std::string format_of(const io::Bytes& bytes) {
    const std::string type = io::media_type(bytes);
    if (type == "image/vnd-ms.dds") return "dds";
    return type.substr(std::min(type.size(), type.find('/') + 1));
}

/// The width and height by the settings, never larger than the image.
std::pair<std::size_t, std::size_t> size_for(const ImageState& image, const ImageSettings& s) {
    std::size_t width = image.width, height = image.height;
    if (const std::size_t longest = std::max(width, height); longest > s.max_size) {
        const auto scaled = [&](std::size_t side) { // rounds to the nearest multiple
            return std::max<std::size_t>(1, (2 * side * s.max_size + longest) / (2 * longest));
        };
        width = scaled(width);
        height = scaled(height);
    }
    if (s.power_of_two) {
        width = std::bit_floor(width);
        height = std::bit_floor(height);
    }
    if (s.format == Format::ktx2) return {width / block * block, height / block * block};
    return {width, height};
}

ImageSettings settings_for(const io::ImageUse& use, const TexturesOptions& o) {
    return use.normals ? for_normals(o) : use.numbers ? for_data(o) : for_colours(o);
}

/// An image in several roles is treated as plain numbers.
io::PixelKind kind_of(const io::ImageUse& use) {
    const int roles = int(use.colours) + int(use.normals) + int(use.numbers);
    if (roles != 1 || use.numbers) return io::PixelKind::numbers;
    return use.normals ? io::PixelKind::normals : io::PixelKind::colours;
}

io::Bytes encoded(const Pixels& image, const std::string& format, const ImageSettings& s,
                  io::PixelKind kind) {
    const io::LossSettings loss{s.quality, s.lossless, kind != io::PixelKind::colours};
    if (format == "jpeg") return io::encoded_jpeg(image, loss);
    if (format == "webp") return io::encoded_webp(image, loss);
    if (format == "avif") return io::encoded_avif(image, loss);
    return io::encoded_png(image);
}

struct Reason {
    const char* why = nullptr; ///< null: process the image
    bool warn = false;
};

/// Throws a stage error (E-KTX).
io::Bytes encoded_ktx2(Pixels image, const io::ImageUse& use, const ImageSettings& s,
                       const TexturesOptions& o) {
    if (!use.alpha)
        for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
    const io::KtxOrder order{use.normals, use.colours, !io::is_opaque(image), s.quality,
                             std::chrono::seconds(o.timeout)};
    io::Bytes bytes = io::run_ktx(io::encoded_png_in_colour(image), order);
    constexpr std::size_t header = 80, format = 12, width = 20, height = 24;
    const auto word = [&](std::size_t at) {
        std::uint32_t n = 0;
        for (std::size_t i = 4; i-- > 0;) n = n << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
        return n;
    };
    if (io::media_type(bytes) != "image/ktx2" || bytes.size() < header || word(format) != 0 ||
        word(width) != image.width || word(height) != image.height)
        throw Error(ErrorKind::stage, "E-KTX", "wrote no KTX2 texture of that image");
    return bytes;
}

/// The reason why a processed image does not become KTX2.
Reason reason_against_ktx2(const ImageState& image, const io::ImageUse& use) {
    if (use.fallback) return {"readers without KTX2 need it"};
    if (use.colours && (use.normals || use.numbers))
        return {"materials use it both as colours and as numbers, but a KTX2 texture supports only one",
                true};
    if (image.width < block || image.height < block)
        return {"the sides of KTX2 textures are multiples of 4 pixels, and images are not made larger", true};
    return {};
}

ProcessedImage kept(const ImageState& state, std::string why, bool warn) {
    ProcessedImage out{state, state, {}, std::move(why), warn};
    return out;
}

/// The reason, from the header alone, to keep an image unchanged.
Reason reason_to_keep(const ImageState& image, const io::ImageUse& use) {
    if (image.bytes == 0) return {"it is missing"}; // an earlier warning reported it
    if (image.format.empty()) return {"its kind is not supported", true};
    if (use.held) return {"it is used outside these parts"};
    if (use.nearest) return {"its pixels are read one by one, like a palette"};
    if (use.textures.empty()) return {"no material uses it"};
    if (image.format == "ktx2" || image.format == "dds" || (image.format == "avif" && !io::has_avif()))
        return {"its format cannot be read"};
    if (image.width == 0) return {"it is broken", true};
    if (image.height > io::max_pixels / image.width) return {"it has more than 2^26 pixels", true};
    return {};
}

} // namespace

ImageState state_of(const io::Bytes& bytes) {
    ImageState state{format_of(bytes), 0, 0, bytes.size()};
    if (const auto size = io::image_size(bytes)) {
        state.width = size->first;
        state.height = size->second;
    }
    return state;
}

ProcessedImage processed_image(const io::Bytes& bytes, const ImageState& before, const io::ImageUse& use,
                               const TexturesOptions& o) {
    if (const Reason r = reason_to_keep(before, use); r.why) return kept(before, r.why, r.warn);
    ImageSettings s = settings_for(use, o);
    std::string format = s.format == Format::keep ? before.format : name_of(s.format);
    if (use.fallback && (format == "webp" || format == "avif"))
        format = before.format; // readers that need the fallback support neither
    std::string why;
    bool warn = false;
    if (format == "ktx2") {
        const Reason against = reason_against_ktx2(before, use);
        if (against.why) {
            why = against.why;
            warn = against.warn;
            format = before.format;
            s.format = Format::keep;
        }
    }
    const auto [width, height] = size_for(before, s);
    const bool smaller = width != before.width || height != before.height;
    if (!smaller && format == before.format) {
        ProcessedImage out = kept(before, why, warn);
        if (o.repack) out.bytes = io::repacked_image(bytes);
        if (!out.bytes.empty()) out.after.bytes = out.bytes.size();
        return out;
    }

    auto image = io::decoded_image(bytes);
    if (!image || image->damaged) return kept(before, "it is broken", true);
    if (format == "jpeg" && before.format != "jpeg" && use.alpha && !io::is_opaque(*image)) {
        why = "its alpha is used, but JPEG has no alpha";
        warn = true;
        format = before.format;
        if (!smaller) return kept(before, why, true);
    }
    const io::PixelKind kind = kind_of(use);
    const bool coverage = kind == io::PixelKind::colours && use.coverage && !io::is_opaque(*image);
    if (smaller) image = io::resized_image(*image, width, height, kind, coverage);
    ProcessedImage out{before,
                       {format, width, height, 0},
                       format == "ktx2" ? encoded_ktx2(*std::move(image), use, s, o)
                                        : encoded(*image, format, s, kind),
                       why,
                       warn};
    if (!smaller && format != "png" && format != "ktx2" && out.bytes.size() >= before.bytes)
        return kept(before, fmt::format("it would not be smaller as {}", format), false);
    out.after.bytes = out.bytes.size();
    return out;
}

} // namespace facetmill::textures_stage
