#pragma once
// Stores numbers that exceed memory, and computes their statistics.

#include "cells/storage/block_file.hpp"
#include "geometry/measure/measure.hpp"

namespace facetmill::cells {

class NumberFile {
  public:
    /// Throws an output error (E-WRITE, E-SPACE).
    explicit NumberFile(const std::filesystem::path& scratch) : file_(scratch), counts_(bins) {}

    /// Adds the finite numbers. Throws an output error (E-WRITE, E-SPACE).
    void add(std::span<const double> numbers);
    /// Like statistics() over all numbers. Reads the file three times. No numbers can be added afterwards.
    /// Throws an output error (E-SCRATCH).
    Statistics statistics();

  private:
    static constexpr int digit = 16; ///< key bits per pass
    static constexpr std::size_t bins = std::size_t{1} << digit;
    std::uint64_t take_digit(std::uint64_t& rank);

    ScratchFile file_;
    Statistics sums_;
    std::vector<std::uint64_t> counts_; ///< numbers by the next digit of their keys
};

} // namespace facetmill::cells
