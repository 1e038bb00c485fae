#include "io/images/image_faults.hpp"

#include "io/images/avif.hpp"
#include "io/images/image_files.hpp"
#include "io/images/pixels.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::io {

namespace {

/// Whether all chunks up to IEND are complete (PNG specification, third edition, 5.3).
bool png_ends(Span bytes) {
    constexpr std::size_t around = 12; // length, type and checksum of a chunk
    for (std::size_t at = 8; at + around <= bytes.size();) {
        const std::size_t length = big_endian(bytes, at, 4), left = bytes.size() - at - around;
        if (length > left) return false;
        if (as_text(bytes.subspan(at + 4, 4)) == "IEND") return true;
        at += around + length;
    }
    return false;
}

/// The offset of a JPEG's first scan (ITU-T T.81, B.1.1.3); 0 if the segments do not lead to a scan.
std::size_t first_scan(Span bytes) {
    constexpr unsigned scan = 0xda, fill = 0xff, temporary = 0x01, first_restart = 0xd0, last_alone = 0xd9;
    for (std::size_t at = 2; at + 4 <= bytes.size();) {
        if (big_endian(bytes, at, 1) != 0xff) return 0;
        const auto marker = big_endian(bytes, at + 1, 1);
        if (marker == scan) return at;
        const bool alone = marker == temporary || (marker >= first_restart && marker <= last_alone);
        if (marker == fill)
            ++at;
        else
            at += alone ? 2 : 2 + big_endian(bytes, at + 2, 2);
    }
    return 0;
}

/// Whether an end marker follows the first scan. An earlier end marker belongs to a thumbnail.
bool jpeg_ends(Span bytes) {
    const auto end = as_text(bytes).rfind("\xff\xd9");
    return end != std::string_view::npos && end > first_scan(bytes);
}

bool webp_ends(Span bytes) { return bytes.size() >= 12 && little_endian(bytes, 4, 4) <= bytes.size() - 8; }

/// Checks the width and the levels (Khronos Texture 2.0, 3.1 and 3.9.7).
std::string ktx2_fault(Span bytes) {
    constexpr std::size_t header = 80, width = 20, levels = 40, of_level = 24;
    if (bytes.size() < header) return "its data end early";
    const auto count = std::max<std::uint64_t>(little_endian(bytes, levels, 4), 1);
    if (little_endian(bytes, width, 4) == 0 || count > 32) return "its header is broken";
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = header + of_level * i;
        if (at + of_level > bytes.size()) return "its data end early";
        const auto begin = little_endian(bytes, at, 8), size = little_endian(bytes, at + 8, 8);
        if (begin > bytes.size() || size > bytes.size() - begin) return "its data end early";
    }
    return {};
}

} // namespace

std::string image_fault(Span bytes) {
    constexpr std::size_t dds_header = 128;
    const std::string type = media_type(bytes);
    if (bytes.empty()) return "it is empty";
    if (type.empty()) return "its kind is unknown";
    if (type == "image/ktx2") return ktx2_fault(bytes);
    if (type == "image/avif" && !avif_ends(bytes)) return "its data end early";
    if (type == "image/avif" && !has_avif()) return {};
    const auto size = type == "image/vnd-ms.dds" ? std::pair<std::size_t, std::size_t>{1, 1}
                                                 : image_size(bytes).value_or(std::pair(0, 0));
    if (size.first == 0 || size.second == 0) return "its header is broken";
    const bool ends = type == "image/png"    ? png_ends(bytes)
                      : type == "image/jpeg" ? jpeg_ends(bytes)
                      : type == "image/webp" ? webp_ends(bytes)
                      : type == "image/avif" ? true // checked above
                                             : bytes.size() >= dds_header;
    return ends ? std::string() : "its data end early";
}

Diagnostic warning_of_fault(const std::string& image, const std::string& fault) {
    return {
        Severity::warning,
        "W-IMAGE",
        fmt::format("the image \"{}\" is written unchanged, but viewers cannot show it: {}", image, fault),
        {},
        "export the image again"};
}

} // namespace facetmill::io
