#include "io/gltf/accessor.hpp"

#include <fmt/format.h>
#include <meshoptimizer.h>

namespace facetmill::io::gltf {

namespace {

/// What an EXT_meshopt_compression object says.
struct Compressed {
    Span bytes;
    std::size_t count, stride;
    std::string mode, filter;
};

/// The decoders check their input, but their preconditions are only assertions, and count decides how much
/// memory is taken: both are checked here. A byte of input gives at most 64 of output (attributes), a
/// triangle or an index.
void check(const Place& place, const Compressed& c) {
    const auto refuse = [&](const std::string& why) { place.fail(why, "E-MESHOPT"); };
    const bool attributes = c.mode == "ATTRIBUTES", triangles = c.mode == "TRIANGLES",
               indices = c.mode == "INDICES";
    if (!attributes && !triangles && !indices) refuse(fmt::format("mode \"{}\" is unknown", c.mode));
    if (attributes && (c.stride == 0 || c.stride % 4 != 0 || c.stride > 256))
        refuse(fmt::format("byteStride {} is not a multiple of 4 up to 256", c.stride));
    if (!attributes && c.stride != 2 && c.stride != 4)
        refuse(fmt::format("byteStride {} is neither 2 nor 4", c.stride));
    if (triangles && c.count % 3 != 0) refuse(fmt::format("count {} is not a multiple of 3", c.count));
    const std::size_t most = attributes  ? (c.bytes.size() + 256) * 64 / c.stride
                             : triangles ? c.bytes.size() * 3
                                         : c.bytes.size();
    if (c.count > most) refuse(fmt::format("{} bytes cannot hold {} elements", c.bytes.size(), c.count));
    if (c.filter == "NONE") return;
    if (!attributes) refuse("a filter needs mode ATTRIBUTES");
    if (c.filter == "OCTAHEDRAL" && c.stride != 4 && c.stride != 8)
        refuse(fmt::format("filter OCTAHEDRAL needs byteStride 4 or 8, found {}", c.stride));
    if (c.filter == "QUATERNION" && c.stride != 8)
        refuse(fmt::format("filter QUATERNION needs byteStride 8, found {}", c.stride));
    if (c.filter != "OCTAHEDRAL" && c.filter != "QUATERNION" && c.filter != "EXPONENTIAL")
        refuse(fmt::format("filter \"{}\" is unknown", c.filter));
}

} // namespace

Bytes decode_meshopt(Source& source, const Place& extension) {
    const Compressed c{source.range(extension), extension.at("count").natural(),
                       extension.at("byteStride").natural(65536), extension.at("mode").text(),
                       extension.text_or("filter", "NONE")};
    check(extension, c);
    source.need(static_cast<double>(c.count) * static_cast<double>(c.stride));
    Bytes out(c.count * c.stride);
    const auto* from = reinterpret_cast<const unsigned char*>(c.bytes.data());
    const int failed = c.mode == "ATTRIBUTES"
                           ? meshopt_decodeVertexBuffer(out.data(), c.count, c.stride, from, c.bytes.size())
                       : c.mode == "TRIANGLES"
                           ? meshopt_decodeIndexBuffer(out.data(), c.count, c.stride, from, c.bytes.size())
                           : meshopt_decodeIndexSequence(out.data(), c.count, c.stride, from, c.bytes.size());
    if (failed)
        extension.fail(fmt::format("the compressed bytes are damaged (meshoptimizer says {})", failed),
                       "E-MESHOPT");
    if (c.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), c.count, c.stride);
    if (c.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), c.count, c.stride);
    if (c.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), c.count, c.stride);
    return out;
}

} // namespace facetmill::io::gltf
