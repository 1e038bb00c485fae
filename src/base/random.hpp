#pragma once
// A counter-based generator: the number at a key is a pure function of seed and key, so neither the order of
// calls nor the number of threads matters.

#include <cstdint>

namespace facetmill {

/// A well-mixed 64-bit value of the two (the finaliser of SplitMix64, applied twice: G. L. Steele, D. Lea and
/// C. H. Flood, "Fast splittable pseudorandom number generators", 2014). Chain it to hash longer keys.
constexpr std::uint64_t hashed(std::uint64_t seed, std::uint64_t key) {
    std::uint64_t z = seed + 0x9e3779b97f4a7c15ULL * (key + 1);
    for (int round = 0; round < 2; ++round) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        z ^= z >> 31;
    }
    return z;
}

/// Uniform in the open interval (0, 1): the 53 high bits, centred in their cell.
constexpr double uniform(std::uint64_t bits) {
    return (static_cast<double>(bits >> 11) + 0.5) * (1.0 / 9007199254740992.0);
}

} // namespace facetmill
