#pragma once
// The inverse of quantisation, computed here: the library, compiled for some processors, rounds once where
// others round twice (a fused multiply and add), and the same file would give other bytes there.

#include <draco/attributes/point_attribute.h>
#include <draco/compression/decode.h>
#include <optional>
#include <vector>

namespace facetmill::io {

/// Has the decoder leave positions, normals and texture coordinates as whole numbers, with what they are
/// steps of.
void keep_quantised(::draco::Decoder& decoder);

/// Whether a mesh was decoded so and yet is not what its file says: attributes of these kinds that are whole
/// numbers in the file come as such of 32 bits. Then it is decoded again, without.
bool has_lost_types(const ::draco::PointCloud& mesh);

struct Dequantised {
    int components;
    std::vector<float> numbers; ///< [values of the attribute * components]
};
/// As the library computes them on a processor that rounds twice; none for what was not left quantised.
/// Throws malformed where the data of the transform cannot be right.
std::optional<Dequantised> dequantised(const ::draco::PointAttribute& attribute);

} // namespace facetmill::io
