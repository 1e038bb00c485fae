#pragma once
// Sums of products of doubles without rounding, for exact signs.

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace facetmill {

/// A sum stored as an expansion: non-overlapping parts, smallest first, so that the last part has the sign of
/// the sum (J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
/// predicates", 1997). capacity: the maximum number of added numbers, where a product counts as two; 0 for
/// any number, at the cost of an allocation. Exact as long as nothing overflows and no product's last bit is
/// below 1e-300.
template <std::size_t capacity = 0>
class ExactSum {
  public:
    /// Adds x (grow-expansion without zeros).
    void add(double x) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < size_; ++i) {
            const double part = parts_[i], sum = x + part, virtual_part = sum - x;
            const double rest = (x - (sum - virtual_part)) + (part - virtual_part);
            if (rest != 0) parts_[kept++] = rest;
            x = sum;
        }
        if constexpr (capacity == 0)
            if (kept == parts_.size()) parts_.push_back(0);
        if (x != 0) parts_[kept++] = x;
        size_ = kept;
    }
    /// Adds a * b; std::fma is exact on every processor.
    void add_product(double a, double b) {
        const double product = a * b;
        // The last bit of a product is at most 2^-105 of it.
        if (!(std::abs(product) > 1e-270 && std::abs(product) < 1e300)) holds_ = holds_ && (a == 0 || b == 0);
        add(std::fma(a, b, -product));
        add(product);
    }
    /// Adds factor times another sum.
    template <std::size_t other>
    void add_scaled(const ExactSum<other>& sum, double factor) {
        for (std::size_t i = 0; i < sum.size_; ++i) add_product(sum.parts_[i], factor);
    }
    /// Whether the products and their sums are all within the range of doubles; otherwise sign() and
    /// value() are meaningless. Sums passed only to add() are trusted.
    bool holds() const { return holds_; }
    int sign() const { return size_ == 0 ? 0 : parts_[size_ - 1] > 0 ? 1 : -1; }
    /// The value, rounded; 0 only for a zero sum.
    double value() const {
        double sum = 0;
        for (std::size_t i = 0; i < size_; ++i) sum += parts_[i];
        return sum;
    }

  private:
    template <std::size_t>
    friend class ExactSum;
    std::conditional_t<capacity == 0, std::vector<double>, std::array<double, capacity>> parts_{};
    std::size_t size_ = 0;
    bool holds_ = true;
};

} // namespace facetmill
