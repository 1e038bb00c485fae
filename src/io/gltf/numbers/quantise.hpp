#pragma once
// Attributes as small integers (KHR_mesh_quantization), and in the forms of meshoptimizer's filters. All
// rounding happens here, in doubles to nearest, so that every processor gives the same integers.

#include "io/bytes.hpp"
#include "io/gltf/document/json.hpp"
#include "mesh/attribute.hpp"
#include "mesh/mesh.hpp"

#include <optional>

namespace facetmill::io::gltf {

/// The grid of a mesh's positions: a stored integer n of `bits` bits represents origin + step * n.
struct PositionGrid {
    Vec3 origin;
    double step = 1;
    int bits = 16;
};

/// The smallest number with 8 digits that is at least x > 0. Its text is short.
[[nodiscard]] double short_above(double x);
/// A number within a hundredth of the step of x with as few decimals as possible.
[[nodiscard]] double short_near(double x, double step);

/// Vertex data ready for a separate view.
struct Stored {
    Json accessor; ///< the accessor without its view
    Bytes bytes;
    std::size_t stride = 0; ///< 0: no gaps between elements
    std::string filter{};   ///< the meshopt filter that decodes the bytes to the accessor's type; empty: none
};

/// The numbers unchanged, with each element padded to 4 bytes; min and max on request.
[[nodiscard]] Stored plain(const AttributeData& data, int components, bool normalised, bool bounds);
/// Positions on a grid, as uint8 or uint16, at most half a step off along each axis. None if a position
/// exceeds the integer range.
[[nodiscard]] std::optional<Stored> on_grid(const std::vector<Vec3>& positions, const PositionGrid& grid);
/// Displacements of positions in grid steps: int16 or, if out of range, float32.
[[nodiscard]] Stored displacements(const Attribute& deltas, const PositionGrid& grid);
/// Numbers from -1 to 1 in 2^(bits - 1) - 1 steps per side, as normalised int8 (up to 8 bits) or int16. The
/// error is at most half a step plus half a step of the integer type. None if a number is out of range.
[[nodiscard]] std::optional<Stored> signed_fractions(const Attribute& a, int bits);
/// Numbers from 0 to 1 in 2^bits - 1 steps, as normalised uint8 or uint16. None if a number is out of range.
[[nodiscard]] std::optional<Stored> fractions(const Attribute& a, int bits);
/// Unit vectors, and the sign of tangents, for meshopt's filter OCTAHEDRAL (Q. Meyer et al., "On
/// Floating-Point Normal Vectors", 2010). The octahedral coordinates have 2^(bits - 1) - 1 steps per side.
/// bits: 2 to 16.
[[nodiscard]] Stored octahedral(const Attribute& a, int bits);
/// Unit quaternions for meshopt's filter QUATERNION, in 4 to 16 bits. None if the length of a quaternion
/// differs from 1 by more than 1e-3.
[[nodiscard]] std::optional<Stored> quaternions(const Attribute& a, int bits = 16);
/// The fewest bits that turn no rotation by more than an angle in radians, at most 16.
[[nodiscard]] int bits_of_turns(const Attribute& a, double angle);
/// Numbers for meshopt's filter EXPONENTIAL with a common exponent: multiples of 2^exponent, with an error of
/// at most half of that. None if a number needs more than 24 bits.
[[nodiscard]] std::optional<Stored> exponential(const Attribute& a, int exponent, bool bounds);
/// The exponent at which the largest number uses all 24 bits. So no error exceeds the float32 step at the
/// largest number.
[[nodiscard]] int finest_exponent(const Attribute& a);
/// The exponent of the largest power of two that is at most the largest component extent / 2^bits.
[[nodiscard]] int exponent_of_range(const Attribute& a, int bits);

/// Weights and joints of a mesh by set. The largest weights of a vertex come first, because neighbours are
/// then more similar. The weights of a vertex, over all sets, sum to exactly one (the largest remainders are
/// rounded up). A joint without weight becomes 0, as glTF requires.
struct Influences {
    std::vector<Attribute> joints, weights;
};
struct StoredInfluences {
    std::vector<Stored> joints, weights;
};
[[nodiscard]] StoredInfluences influences(const Influences& all, int bits);

} // namespace facetmill::io::gltf
