#pragma once
// Attributes as small integers (KHR_mesh_quantization) and as meshoptimizer's filters want them. All is
// rounded here, in doubles and to nearest, so that every processor gives the same integers.

#include "io/bytes.hpp"
#include "io/gltf/document/json.hpp"
#include "mesh/attribute.hpp"
#include "mesh/mesh.hpp"

#include <optional>

namespace facetmill::io::gltf {

/// The grid of a mesh's positions: a stored integer n of so many bits stands for origin + step * n.
struct PositionGrid {
    Vec3 origin;
    double step = 1;
    int bits = 16;
};

/// The least number at or above x > 0 that has 8 digits, so that it is short as text.
double short_above(double x);
/// A number within a hundredth of the step of x that has as few decimals as that allows.
double short_near(double x, double step);

/// Vertex data ready for a view of its own.
struct Stored {
    Json accessor; ///< without its view
    Bytes bytes;
    std::size_t stride = 0; ///< 0: elements lie without gaps
    std::string filter{};   ///< of meshopt, which makes of the bytes what the accessor says; empty: none
};

/// Numbers as they are, each element padded to 4 bytes; min and max when asked for.
Stored plain(const AttributeData& data, int components, bool normalised, bool bounds);
/// Positions on a grid, as uint8 or uint16. Each is at most half a step off in every
/// direction. None when one is beyond what the integers reach.
std::optional<Stored> on_grid(const std::vector<Vec3>& positions, const PositionGrid& grid);
/// Displacements of positions in steps of the grid: int16 or, where that does not reach, float32.
Stored displacements(const Attribute& deltas, const PositionGrid& grid);
/// Numbers from -1 to 1 in 2^(bits - 1) - 1 steps to either side, as normalised int8 (up to 8 bits) or int16:
/// at most half a step off, and half a step of the integer type. None when one is beyond.
std::optional<Stored> signed_fractions(const Attribute& a, int bits);
/// Numbers from 0 to 1 in 2^bits - 1 steps, as normalised uint8 or uint16. None when one is beyond.
std::optional<Stored> fractions(const Attribute& a, int bits);
/// Unit vectors, and the sign of tangents, for meshopt's filter OCTAHEDRAL (Q. Meyer et al., "On
/// Floating-Point Normal Vectors", 2010): the coordinates on the octahedron have 2^(bits - 1) - 1 steps to
/// either side. bits: 2 to 16.
Stored octahedral(const Attribute& a, int bits);
/// Unit quaternions for meshopt's filter QUATERNION, in 16 bits. None when one is not of unit length within
/// 1e-3.
std::optional<Stored> quaternions(const Attribute& a);
/// Numbers for meshopt's filter EXPONENTIAL, all with this exponent: multiples of 2^exponent, at most half of
/// that off. None when one is too large for 24 bits.
std::optional<Stored> exponential(const Attribute& a, int exponent, bool bounds);
/// The exponent at which the largest number has all 24 bits: no number is off by more than float32's step at
/// the largest.
int finest_exponent(const Attribute& a);
/// The exponent of the largest power of two that is not above the greatest extent of a component / 2^bits.
int exponent_of_range(const Attribute& a, int bits);

/// Weights and joints of a mesh by set, the largest weights of a vertex first, since neighbours are more
/// alike then. The weights of a vertex, over all sets, sum to exactly one (the largest remainders are rounded
/// up); a joint without weight becomes 0, as glTF wants it.
struct Influences {
    std::vector<Attribute> joints, weights;
};
struct StoredInfluences {
    std::vector<Stored> joints, weights;
};
StoredInfluences influences(const Influences& all, int bits);

} // namespace facetmill::io::gltf
