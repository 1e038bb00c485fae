#pragma once
// Prepares numbers so that Draco's quantisation gives the same integers on every processor. The library
// rounds floor(x * steps + 1/2) in floating point. With fused multiply-add, this has one rounding instead of
// two, so numbers near the middle between two steps can round either way. They are moved before the library
// gets them.

#include "io/gltf/draco/draco.hpp"

namespace facetmill::io {

/// A grid of equal steps along every axis, in float32 as Draco stores it. `range` is divided into 2^bits - 1
/// steps, and every component has its own origin.
struct DracoGrid {
    std::vector<float> origin;
    float range = 1;
    int bits = 1;

    /// Steps per unit, with the library's own rounding.
    float density() const;
};

/// The library stores origin and range of a grid as text with six decimals. These return the nearest numbers
/// that the text represents exactly: at most x, and at least x plus a millionth.
[[nodiscard]] float storable_below(float x);
[[nodiscard]] float storable_above(float x);
/// The number of bits for which steps of a storable grid are as fine as steps of `range` with `bits` bits,
/// within a quarter. More bits are needed if the range is not large compared to six decimals. At most 30.
[[nodiscard]] int bits_as_fine(int bits, float range, float storable);

/// The storable grid that starts at the minimum of each component and covers the largest extent.
[[nodiscard]] DracoGrid grid_of(const std::vector<float>& numbers, int components, int bits);

/// x, or the nearest float32 that rounds to the same step with and without fused multiply-add.
[[nodiscard]] float settled(float x, float origin, float density);
/// The step that Draco rounds a settled number to.
[[nodiscard]] std::uint32_t step_of(float x, float origin, float density);
/// Settles all numbers, component by component.
void settle(std::vector<float>& numbers, const DracoGrid& grid);

/// Decoded numbers may differ in the last bit by processor. Replaces them by origin + step * range / (2^bits
/// - 1), rounded after each operation.
void put_on_grid(std::vector<float>& decoded, const DracoGrid& grid);

/// Adjusts normals (three numbers each) so that their octahedral coordinates (Q. Meyer et al., "On
/// Floating-Point Normal Vectors", 2010) are the same with and without fused multiply-add. Unstable normals
/// are replaced by the integers on the octahedron. bits: 2 to 30.
void settle_normals(std::vector<float>& normals, int bits);

} // namespace facetmill::io
