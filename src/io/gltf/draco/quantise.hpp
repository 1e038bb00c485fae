#pragma once
// Numbers that Draco's quantisation gives the same integers on every processor. The library rounds
// floor(x * steps + 1/2) in floating point, and a compiler for a processor with fused multiply-add computes
// that with one rounding instead of two, so that numbers close to the middle between two steps fall on one or
// the other. Such numbers are moved before the library sees them.

#include "io/gltf/draco/draco.hpp"

namespace facetmill::io {

/// A grid of equal steps along every axis, in float32 as Draco stores it: `range` is divided into 2^bits - 1
/// steps, and every component has an origin of its own.
struct DracoGrid {
    std::vector<float> origin;
    float range = 1;
    int bits = 1;

    /// Steps per unit, with the library's own rounding.
    float density() const;
};

/// The library is told origin and range of a grid as text with six decimals. The nearest numbers that this
/// text holds: at most x, and at least x and a millionth.
float storable_below(float x);
float storable_above(float x);
/// As many bits as make steps of a grid that is storable as fine as `bits` made those of `range`, within a
/// quarter: more where the range is not large beside the six decimals. At most 30.
int bits_as_fine(int bits, float range, float storable);

/// The storable grid from the least number of each component to the greatest extent.
DracoGrid grid_of(const std::vector<float>& numbers, int components, int bits);

/// x, or the nearest float32 that is rounded to the same step with and without fused multiply-add.
float settled(float x, float origin, float density);
/// The step that Draco rounds a settled number to.
std::uint32_t step_of(float x, float origin, float density);
/// Settles all numbers, component by component.
void settle(std::vector<float>& numbers, const DracoGrid& grid);

/// Numbers that were decoded, which the last bit may tell apart by processor, as the grid has them: origin +
/// step * range / (2^bits - 1), rounded after each operation.
void put_on_grid(std::vector<float>& decoded, const DracoGrid& grid);

/// Normals, three numbers each, whose octahedral coordinates (Q. Meyer et al., "On Floating-Point Normal
/// Vectors", 2010) are the same with and without fused multiply-add; those that were not are the integers on
/// the octahedron. bits: 2 to 30.
void settle_normals(std::vector<float>& normals, int bits);

} // namespace facetmill::io
