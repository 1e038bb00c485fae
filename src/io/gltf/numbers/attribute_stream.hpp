#pragma once
// Mode ATTRIBUTES of KHR_meshopt_compression in version 1, which older libraries do not know: as its appendix
// A says it (bytes of elements apart, as differences, in groups of 16 that have 0, 1, 2, 4 or 8 bits each).

#include "io/bytes.hpp"

#include <optional>

namespace facetmill::io::gltf {

/// Whether the stream is of version 1.
bool is_attribute_stream_1(Span stream);

/// count elements of `stride` bytes as a stream. Each channel of 4 bytes has the differences (of bytes, of
/// 16-bit numbers, or of bits) that take least. stride: a multiple of 4 up to 256; bytes: count * stride.
Bytes encode_attribute_stream(Span bytes, std::size_t count, std::size_t stride);

/// The elements of a stream of version 1; none when it is damaged. Takes count * stride bytes of memory.
std::optional<Bytes> decode_attribute_stream(Span stream, std::size_t count, std::size_t stride);

/// The most elements that a stream of so many bytes can hold.
std::size_t most_elements_in_stream(std::size_t bytes, std::size_t stride);

} // namespace facetmill::io::gltf
