#pragma once
// Gaussian noise that belongs to places: a pure function of a seed and a position, so that neither order nor
// threads nor the file matter.

#include "base/vec.hpp"

#include <cstdint>

namespace facetmill {

/// A standard normal number, cut off at `truncate`, that is a pure function of its key. Numbers beyond the
/// cut are drawn again, never clamped, so nothing heaps up there.
double gaussian(std::uint64_t key, double truncate);

/// The key of the noise at a world position: equal for positions equal in float32 (-0 is 0).
std::uint64_t noise_key(std::uint64_t seed, const Vec3& world);

/// Noise that is alike at places that are near each other: normal numbers on the points of a lattice, mixed
/// by smooth weights and scaled to deviation 1 everywhere (value noise); octaves of twice the frequency and
/// `roughness` times the amount each are added.
struct CorrelatedNoise {
    double frequency = 1; ///< lattice cells per world unit, above 0
    int octaves = 1;
    double roughness = 0.5; ///< amount of an octave beside the one before
    double truncate = 3;

    /// The amount at a world position, taken as float32; clamped to the cut.
    double at(std::uint64_t seed, const Vec3& world) const;
};

} // namespace facetmill
