#include "stages/textures/work.hpp"

#include "io/encode_image.hpp"
#include "io/image_files.hpp"
#include "io/resize_image.hpp"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace facetmill::textures_stage {

namespace {

using io::Pixels;

std::string format_of(const io::Bytes& bytes) {
    const std::string type = io::media_type(bytes);
    if (type == "image/vnd-ms.dds") return "dds";
    return type.substr(std::min(type.size(), type.find('/') + 1));
}

/// The width and height that the settings ask for, never more than there are.
std::pair<std::size_t, std::size_t> size_for(const ImageState& image, const ImageSettings& s) {
    std::size_t width = image.width, height = image.height;
    if (const std::size_t longest = std::max(width, height); longest > s.max_size) {
        const auto scaled = [&](std::size_t side) { // rounded to the nearest
            return std::max<std::size_t>(1, (2 * side * s.max_size + longest) / (2 * longest));
        };
        width = scaled(width);
        height = scaled(height);
    }
    if (s.power_of_two) return {std::bit_floor(width), std::bit_floor(height)};
    return {width, height};
}

ImageSettings settings_for(const io::ImageUse& use, const TexturesOptions& o) {
    return use.normals ? for_normals(o) : use.numbers ? for_data(o) : for_colours(o);
}

/// In several roles, the plain numbers are what all of them have in common.
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
    return io::encoded_png(image);
}

Worked kept(const ImageState& state, std::string why, bool warn) {
    Worked out{state, state, {}, std::move(why), warn};
    return out;
}

struct Reason {
    const char* why = nullptr; ///< nothing: the image is to be worked on
    bool warn = false;
};

/// Why an image stays of which nothing but the header is read.
Reason reason_to_keep(const ImageState& image, const io::ImageUse& use) {
    if (image.bytes == 0) return {"it is not there"}; // which was said when it was missed
    if (image.format.empty()) return {"it is of no kind that is read", true};
    if (use.held) return {"something else than the materials of these parts reads it"};
    if (use.nearest) return {"its pixels are read one by one, as those of a palette are"};
    if (use.textures.empty()) return {"no material uses it"};
    if (image.format == "ktx2" || image.format == "dds") return {"its format is not read"};
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

Worked worked(const io::Bytes& bytes, const ImageState& before, const io::ImageUse& use,
              const TexturesOptions& o) {
    if (const Reason r = reason_to_keep(before, use); r.why) return kept(before, r.why, r.warn);
    const ImageSettings s = settings_for(use, o);
    std::string format = s.format == Format::keep ? before.format : name_of(s.format);
    if (use.fallback && format == "webp") format = before.format; // who needs it does not know WebP
    const auto [width, height] = size_for(before, s);
    const bool smaller = width != before.width || height != before.height;
    if (!smaller && format == before.format) {
        Worked out = kept(before, "", false);
        if (o.repack) out.bytes = io::repacked_image(bytes);
        if (!out.bytes.empty()) out.after.bytes = out.bytes.size();
        return out;
    }

    auto image = io::decoded_image(bytes);
    if (!image || image->damaged) return kept(before, "it is broken", true);
    std::string why;
    if (format == "jpeg" && before.format != "jpeg" && use.alpha && !io::is_opaque(*image)) {
        why = "its alpha is used, which JPEG has not";
        format = before.format;
        if (!smaller) return kept(before, why, true);
    }
    const io::PixelKind kind = kind_of(use);
    const bool coverage = kind == io::PixelKind::colours && use.coverage && !io::is_opaque(*image);
    if (smaller) image = io::resized_image(*image, width, height, kind, coverage);
    Worked out{before, {format, width, height, 0}, encoded(*image, format, s, kind), why, !why.empty()};
    if (!smaller && format != "png" && out.bytes.size() >= before.bytes)
        return kept(before, fmt::format("it would not be smaller as {}", format), false);
    out.after.bytes = out.bytes.size();
    return out;
}

} // namespace facetmill::textures_stage
