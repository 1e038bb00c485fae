#pragma once
// A counter-based random generator. The number for a key is a pure function of seed and key, independent of
// the order of calls and the number of threads.

#include <cstdint>

namespace facetmill {

/// Mixes bits: every output bit depends on all bits of z, and different inputs give different outputs. 0
/// gives 0. (The finaliser of SplitMix64: G. L. Steele, D. Lea and C. H. Flood, "Fast splittable pseudorandom
/// number generators", 2014.)
[[nodiscard]] constexpr std::uint64_t mixed_bits(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
}

/// A well-mixed 64-bit hash of seed and key. Chain calls to hash longer keys.
[[nodiscard]] constexpr std::uint64_t hashed(std::uint64_t seed, std::uint64_t key) {
    return mixed_bits(mixed_bits(seed + 0x9e3779b97f4a7c15ULL * (key + 1)));
}

/// Uniform in the open interval (0, 1): the 53 high bits, centred in their cell.
[[nodiscard]] constexpr double uniform(std::uint64_t bits) {
    return (static_cast<double>(bits >> 11) + 0.5) * (1.0 / 9007199254740992.0);
}

} // namespace facetmill
