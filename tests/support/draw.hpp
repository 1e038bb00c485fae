#pragma once
// Choices of a random test, one after the other: the same for the same seed, on every machine.

#include "base/math/random.hpp"

#include <cstddef>
#include <initializer_list>
#include <vector>

namespace facetmill::test {

class Draw {
  public:
    explicit Draw(std::uint64_t seed) : seed_(seed) {}

    std::uint64_t bits() { return hashed(seed_, draws_++); }
    /// 0 to n - 1, or 0 when n is 0.
    std::size_t below(std::size_t n) {
        return static_cast<std::size_t>(uniform(bits()) * static_cast<double>(n));
    }
    double between(double low, double high) { return low + (high - low) * uniform(bits()); }
    bool once_in(std::size_t n) { return below(n) == n - 1; }
    template <class T>
    const T& one_of(const std::vector<T>& items) {
        return items[below(items.size())];
    }
    const char* word(std::initializer_list<const char*> words) {
        return *(words.begin() + below(words.size()));
    }

  private:
    std::uint64_t seed_ = 0, draws_ = 0;
};

} // namespace facetmill::test
