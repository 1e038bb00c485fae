#include "io/images/avif.hpp"

#include "base/error.hpp"
#include "facetmill_parts.hpp"

#include <algorithm>
#include <fmt/format.h>

#if FACETMILL_AVIF
#include <avif/avif.h>
#include <memory>
#endif

namespace facetmill::io {

namespace {

constexpr std::size_t box_header = 8; ///< length and type of a box (ISO/IEC 14496-12, section 4.2)

/// The length of the box at an offset; 0 if the bytes end first. A box may reach to the end of the file.
std::size_t box_length(Span bytes, std::size_t at) {
    if (bytes.size() - at < box_header) return 0;
    std::uint64_t length = big_endian(bytes, at, 4);
    if (length == 0) return bytes.size() - at;
    if (length == 1 && bytes.size() - at >= 16) length = big_endian(bytes, at + 8, 8);
    return length >= box_header && length <= bytes.size() - at ? static_cast<std::size_t>(length) : 0;
}

} // namespace

bool is_avif(Span bytes) {
    if (bytes.size() < 16 || as_text(bytes.subspan(4, 4)) != "ftyp") return false;
    const std::size_t end = std::min<std::size_t>(big_endian(bytes, 0, 4), bytes.size());
    for (std::size_t at = 8; at + 4 <= end; at += at == 8 ? 8 : 4) { // the second word is a version
        const std::string_view brand = as_text(bytes.subspan(at, 4));
        if (brand == "avif" || brand == "avis") return true;
    }
    return false;
}

bool avif_ends(Span bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t length = box_length(bytes, at);
        if (length == 0) return false;
        at += length;
    }
    return true;
}

#if FACETMILL_AVIF

namespace {

struct FreeAvif {
    void operator()(avifDecoder* decoder) const { ::avifDecoderDestroy(decoder); }
    void operator()(avifEncoder* encoder) const { ::avifEncoderDestroy(encoder); }
    void operator()(avifImage* image) const { ::avifImageDestroy(image); }
};

/// The pixels as libavif sees them. Its own conversion gives the same result on every processor, unlike
/// that of libyuv.
avifRGBImage view_of(const avifImage& image, std::uint8_t* pixels) {
    avifRGBImage rgb;
    ::avifRGBImageSetDefaults(&rgb, &image);
    rgb.format = AVIF_RGB_FORMAT_RGBA;
    rgb.depth = 8;
    rgb.avoidLibYUV = AVIF_TRUE;
    rgb.pixels = pixels;
    rgb.rowBytes = 4 * image.width;
    return rgb;
}

[[noreturn]] void fail(avifResult result) {
    if (result == AVIF_RESULT_OUT_OF_MEMORY) throw out_of_memory("no memory to write an image as AVIF");
    throw Error(ErrorKind::stage, "E-AVIF",
                fmt::format("libavif cannot write an image: {}", ::avifResultToString(result)));
}

} // namespace

bool has_avif() {
    return ::avifCodecName(AVIF_CODEC_CHOICE_AOM, AVIF_CODEC_FLAG_CAN_ENCODE) != nullptr &&
           ::avifCodecName(AVIF_CODEC_CHOICE_AUTO, AVIF_CODEC_FLAG_CAN_DECODE) != nullptr;
}

std::optional<Pixels> decoded_avif(Span bytes, bool header) {
    const std::unique_ptr<avifDecoder, FreeAvif> decoder(::avifDecoderCreate());
    if (!decoder) return {};
    decoder->maxThreads = 1;
    decoder->ignoreExif = decoder->ignoreXMP = AVIF_TRUE;
    decoder->imageSizeLimit = static_cast<std::uint32_t>(max_pixels);
    decoder->strictFlags = AVIF_STRICT_DISABLED; // as browsers, which read the files of older encoders
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    if (::avifDecoderSetIOMemory(decoder.get(), data, bytes.size()) != AVIF_RESULT_OK ||
        ::avifDecoderParse(decoder.get()) != AVIF_RESULT_OK)
        return {};
    const avifImage& image = *decoder->image;
    if (image.width == 0 || image.height == 0) return {};
    Pixels pixels{image.width, image.height, {}, false};
    if (header) return pixels;
    constexpr avifTransformFlags moved = AVIF_TRANSFORM_CLAP | AVIF_TRANSFORM_IROT | AVIF_TRANSFORM_IMIR;
    if (pixels.width > max_pixels / pixels.height || (image.transformFlags & moved) != 0 ||
        ::avifDecoderNextImage(decoder.get()) != AVIF_RESULT_OK)
        return {};
    if (decoder->image->width != pixels.width || decoder->image->height != pixels.height) return {};
    pixels.rgba.resize(4 * pixels.width * pixels.height);
    avifRGBImage rgb = view_of(*decoder->image, pixels.rgba.data());
    if (::avifImageYUVToRGB(decoder->image, &rgb) != AVIF_RESULT_OK) return {};
    return pixels;
}

Bytes encoded_avif(const Pixels& image, const LossSettings& settings) {
    const bool whole = settings.lossless || settings.as_numbers; // chroma is not subsampled
    const std::unique_ptr<avifImage, FreeAvif> picture(
        ::avifImageCreate(static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height),
                          8, whole ? AVIF_PIXEL_FORMAT_YUV444 : AVIF_PIXEL_FORMAT_YUV420));
    const std::unique_ptr<avifEncoder, FreeAvif> encoder(::avifEncoderCreate());
    if (!picture || !encoder) fail(AVIF_RESULT_OUT_OF_MEMORY);
    picture->colorPrimaries = AVIF_COLOR_PRIMARIES_BT709;
    picture->transferCharacteristics = AVIF_TRANSFER_CHARACTERISTICS_SRGB;
    picture->matrixCoefficients =
        settings.lossless ? AVIF_MATRIX_COEFFICIENTS_IDENTITY : AVIF_MATRIX_COEFFICIENTS_BT601;
    picture->yuvRange = AVIF_RANGE_FULL;
    avifRGBImage rgb = view_of(*picture, const_cast<std::uint8_t*>(image.rgba.data())); // only read
    rgb.ignoreAlpha = is_opaque(image) ? AVIF_TRUE : AVIF_FALSE;
    if (const avifResult result = ::avifImageRGBToYUV(picture.get(), &rgb); result != AVIF_RESULT_OK)
        fail(result);
    encoder->codecChoice = AVIF_CODEC_CHOICE_AOM;
    encoder->maxThreads = 1; // the same bytes for any number of threads
    encoder->speed = 6;
    const int quantizer =
        settings.lossless ? 0 : (100 - settings.quality) * AVIF_QUANTIZER_WORST_QUALITY / 100;
    encoder->minQuantizer = encoder->maxQuantizer = quantizer;
    encoder->minQuantizerAlpha = encoder->maxQuantizerAlpha = quantizer;
    avifRWData out = AVIF_DATA_EMPTY;
    const avifResult result = ::avifEncoderWrite(encoder.get(), picture.get(), &out);
    const auto* data = reinterpret_cast<const std::byte*>(out.data);
    Bytes bytes = result == AVIF_RESULT_OK ? Bytes(data, data + out.size) : Bytes{};
    ::avifRWDataFree(&out);
    if (result != AVIF_RESULT_OK) fail(result);
    return bytes;
}

#else

bool has_avif() { return false; }

std::optional<Pixels> decoded_avif(Span, bool) { return {}; }

Bytes encoded_avif(const Pixels&, const LossSettings&) {
    throw Error(ErrorKind::stage, "E-AVIF", "this build has no libavif");
}

#endif

} // namespace facetmill::io
