#include "io/gltf/document/accessor.hpp"

#include "io/gltf/numbers/attribute_stream.hpp"
#include "parallel/parallel.hpp"

#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <meshoptimizer.h>

namespace facetmill::io::gltf {

namespace {

/// The contents of an EXT_meshopt_compression or KHR_meshopt_compression object.
struct Compressed {
    Span bytes;
    std::size_t count, stride;
    std::string mode, filter;
};

/// Checks the decoders' preconditions, which they only assert, and count, which decides the allocated
/// memory. A byte of input gives at most 64 bytes of output (attributes; 1024 in version 1), a triangle or
/// an index.
void check(const JsonCursor& place, const Compressed& c) {
    const auto refuse = [&](const std::string& why) { place.fail(why, "E-MESHOPT"); };
    const bool attributes = c.mode == "ATTRIBUTES", triangles = c.mode == "TRIANGLES",
               indices = c.mode == "INDICES";
    if (!attributes && !triangles && !indices) refuse(fmt::format("mode \"{}\" is unknown", c.mode));
    if (attributes && (c.stride == 0 || c.stride % 4 != 0 || c.stride > 256))
        refuse(fmt::format("byteStride {} is not a multiple of 4 up to 256", c.stride));
    if (!attributes && c.stride != 2 && c.stride != 4)
        refuse(fmt::format("byteStride {} is neither 2 nor 4", c.stride));
    if (triangles && c.count % 3 != 0) refuse(fmt::format("count {} is not a multiple of 3", c.count));
    const std::size_t most = attributes && is_attribute_stream_1(c.bytes)
                                 ? most_elements_in_stream(c.bytes.size(), c.stride)
                             : attributes ? (c.bytes.size() + 256) * 64 / c.stride
                             : triangles  ? c.bytes.size() * 3
                                          : c.bytes.size();
    if (c.count > most) refuse(fmt::format("{} bytes cannot hold {} elements", c.bytes.size(), c.count));
    if (c.filter == "NONE") return;
    if (!attributes) refuse("a filter needs mode ATTRIBUTES");
    if (c.filter == "OCTAHEDRAL" && c.stride != 4 && c.stride != 8)
        refuse(fmt::format("filter OCTAHEDRAL needs byteStride 4 or 8, found {}", c.stride));
    if (c.filter == "QUATERNION" && c.stride != 8)
        refuse(fmt::format("filter QUATERNION needs byteStride 8, found {}", c.stride));
    if (c.filter == "COLOR" && c.stride != 4 && c.stride != 8)
        refuse(fmt::format("filter COLOR needs byteStride 4 or 8, found {}", c.stride));
    if (c.filter != "OCTAHEDRAL" && c.filter != "QUATERNION" && c.filter != "EXPONENTIAL" &&
        c.filter != "COLOR")
        refuse(fmt::format("filter \"{}\" is unknown", c.filter));
}

/// Decodes KHR_meshopt_compression's filter COLOR to red, green, blue and alpha. The input is luma and two
/// chrominances of K bits. Alpha has one bit less, below a bit that marks K.
template <class Unsigned>
void decode_colours(Bytes& bytes) {
    using Signed = std::make_signed_t<Unsigned>;
    constexpr double most = std::numeric_limits<Unsigned>::max();
    parallel_for(bytes.size() / (4 * sizeof(Unsigned)), [&](std::size_t i) {
        Unsigned in[4];
        std::byte* at = bytes.data() + i * sizeof(in);
        std::memcpy(in, at, sizeof(in));
        const int y = in[0], co = static_cast<Signed>(in[1]), cg = static_cast<Signed>(in[2]);
        const int scale = (1 << std::bit_width(unsigned{in[3]})) - 1;
        const int alpha = in[3] & (scale >> 1);
        const int given[4] = {y + co - cg, y + cg, y - co - cg, alpha << 1 | (alpha & 1)};
        for (std::size_t c = 0; c < 4; ++c)
            in[c] = scale == 0 ? Unsigned{0} : as_component<Unsigned>(given[c] * most / scale);
        std::memcpy(at, in, sizeof(in));
    });
}

/// Applies the filter of a view.
Bytes filtered(Bytes out, const Compressed& c) {
    if (c.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), c.count, c.stride);
    if (c.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), c.count, c.stride);
    if (c.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), c.count, c.stride);
    if (c.filter == "COLOR" && c.stride == 4) decode_colours<std::uint8_t>(out);
    if (c.filter == "COLOR" && c.stride == 8) decode_colours<std::uint16_t>(out);
    return out;
}

} // namespace

std::optional<JsonCursor> meshopt_extension(const JsonCursor& owner) {
    const auto extensions = owner.find("extensions");
    if (!extensions) return {};
    for (const char* name : meshopt_names)
        if (const auto found = extensions->find(name)) return found;
    return {};
}

Bytes decode_meshopt(Source& source, const JsonCursor& extension) {
    const Compressed c{source.range(extension), extension.at("count").natural(),
                       extension.at("byteStride").natural(65536), extension.at("mode").text(),
                       extension.text_or("filter", "NONE")};
    check(extension, c);
    source.need(static_cast<double>(c.count) * static_cast<double>(c.stride));
    Bytes out(c.count * c.stride);
    if (c.mode == "ATTRIBUTES" && is_attribute_stream_1(c.bytes)) {
        auto decoded = decode_attribute_stream(c.bytes, c.count, c.stride);
        if (!decoded) extension.fail("the compressed bytes are damaged", "E-MESHOPT");
        return filtered(std::move(*decoded), c);
    }
    const auto* from = reinterpret_cast<const unsigned char*>(c.bytes.data());
    const int failed = c.mode == "ATTRIBUTES"
                           ? meshopt_decodeVertexBuffer(out.data(), c.count, c.stride, from, c.bytes.size())
                       : c.mode == "TRIANGLES"
                           ? meshopt_decodeIndexBuffer(out.data(), c.count, c.stride, from, c.bytes.size())
                           : meshopt_decodeIndexSequence(out.data(), c.count, c.stride, from, c.bytes.size());
    if (failed)
        extension.fail(fmt::format("the compressed bytes are damaged (meshoptimizer says {})", failed),
                       "E-MESHOPT");
    return filtered(std::move(out), c);
}

} // namespace facetmill::io::gltf
