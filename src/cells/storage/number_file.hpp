#pragma once
// Numbers that are more than memory takes, and their statistics.

#include "cells/storage/block_file.hpp"
#include "geometry/measure/measure.hpp"

namespace facetmill::cells {

class NumberFile {
  public:
    /// Throws output (E-WRITE, E-SPACE).
    explicit NumberFile(const std::filesystem::path& scratch) : file_(scratch), counts_(bins) {}

    /// Those that are finite. Throws output (E-WRITE, E-SPACE).
    void add(std::span<const double> numbers);
    /// As statistics(), of all: the file is read three times. Nothing can be added afterwards. Throws output
    /// (E-SCRATCH).
    Statistics statistics();

  private:
    static constexpr int digit = 16; ///< bits of a number's key that are looked at in one pass
    static constexpr std::size_t bins = std::size_t{1} << digit;
    std::uint64_t take_digit(std::uint64_t& rank);

    ScratchFile file_;
    Statistics sums_;
    std::vector<std::uint64_t> counts_; ///< numbers by the next digit of their keys
};

} // namespace facetmill::cells
