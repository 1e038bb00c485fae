#pragma once
// The inverse of quantisation, computed here. The library's result depends on whether the compiler uses fused
// multiply-add, so the same file would give different bytes on different processors.

#include <draco/attributes/point_attribute.h>
#include <draco/compression/decode.h>
#include <optional>
#include <vector>

namespace facetmill::io {

/// Makes the decoder leave positions, normals and texture coordinates as integers with their quantisation
/// data.
void keep_quantised(::draco::Decoder& decoder);

/// True if keep_quantised lost types: integer attributes of these kinds become 32-bit integers. Then the
/// mesh must be decoded again without keep_quantised.
bool has_lost_types(const ::draco::PointCloud& mesh);

struct Dequantised {
    int components;
    std::vector<float> numbers; ///< [values of the attribute * components] decoded numbers
};
/// Dequantises like the library without fused multiply-add. None for attributes that were not left
/// quantised. Throws a malformed-input error when the transform data is invalid.
[[nodiscard]] std::optional<Dequantised> dequantised(const ::draco::PointAttribute& attribute);

} // namespace facetmill::io
