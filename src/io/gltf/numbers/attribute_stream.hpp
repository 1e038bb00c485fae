#pragma once
// Mode ATTRIBUTES of KHR_meshopt_compression version 1, which older libraries do not support. Implements its
// appendix A: it splits bytes of elements into planes of differences. Groups of 16 differences have 0, 1, 2,
// 4 or 8 bits each.

#include "io/bytes.hpp"

#include <optional>

namespace facetmill::io::gltf {

/// True if the stream has version 1.
bool is_attribute_stream_1(Span stream);

/// Encodes count elements of `stride` bytes. Each 4-byte channel uses the smallest differences (of bytes, of
/// 16-bit numbers, or of bits). stride: a multiple of 4 up to 256; bytes: count * stride.
[[nodiscard]] Bytes encode_attribute_stream(Span bytes, std::size_t count, std::size_t stride);

/// Decodes a stream of version 1; none when it is damaged. Needs count * stride bytes of memory.
[[nodiscard]] std::optional<Bytes> decode_attribute_stream(Span stream, std::size_t count,
                                                           std::size_t stride);

/// The maximum number of elements in a stream of this size.
[[nodiscard]] std::size_t most_elements_in_stream(std::size_t bytes, std::size_t stride);

} // namespace facetmill::io::gltf
