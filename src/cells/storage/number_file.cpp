#include "cells/storage/number_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace facetmill::cells {

namespace {

constexpr std::size_t at_once = 8192; // numbers read at once

constexpr std::uint64_t sign = std::uint64_t{1} << 63;

/// Keys sort like the numbers; -0 equals 0.
std::uint64_t key_of(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x + 0.0);
    return bits & sign ? ~bits : bits | sign;
}

double number_of(std::uint64_t key) { return std::bit_cast<double>(key & sign ? key & ~sign : ~key); }

/// Calls take(numbers) for batches, in order.
template <class Take>
void each_block(const ReadFile& file, std::uint64_t count, Take&& take) {
    Stream stream(file, 0, count * sizeof(double));
    std::vector<double> some;
    while (stream.left() > 0) {
        some.resize(std::min<std::uint64_t>(at_once, stream.left() / sizeof(double)));
        std::memcpy(some.data(), stream.take(some.size() * sizeof(double)), some.size() * sizeof(double));
        take(some);
    }
}

} // namespace

void NumberFile::add(std::span<const double> numbers) {
    std::vector<double> some;
    some.reserve(at_once);
    const auto flush = [&] {
        double sum = 0; // sum of a batch, which adds small terms to small terms
        for (const double x : some) sum += x;
        sums_.sum += sum;
        file_.append(std::as_bytes(std::span(some)));
        some.clear();
    };
    for (const double x : numbers) {
        if (!std::isfinite(x)) continue;
        sums_.minimum = sums_.count == 0 ? x : std::min(sums_.minimum, x);
        sums_.maximum = sums_.count == 0 ? x : std::max(sums_.maximum, x);
        ++sums_.count;
        ++counts_[key_of(x) >> (64 - digit)];
        some.push_back(x);
        if (some.size() == at_once) flush();
    }
    flush();
}

/// The bin of the number with this rank; the rank becomes relative to the bin.
std::uint64_t NumberFile::take_digit(std::uint64_t& rank) {
    std::uint64_t bin = 0;
    for (; rank >= counts_[bin]; ++bin) rank -= counts_[bin];
    std::fill(counts_.begin(), counts_.end(), 0);
    return bin;
}

Statistics NumberFile::statistics() {
    const auto file = file_.finish();
    Statistics s = sums_;
    if (s.count == 0) return s;
    s.mean = s.sum / static_cast<double>(s.count);
    std::uint64_t rank = s.count / 2, key = take_digit(rank);
    double squares = 0;
    for (int known = digit; known < 64; known += digit) {
        each_block(*file, s.count, [&](const std::vector<double>& some) {
            double sum = 0;
            for (const double x : some) {
                if (known == digit) sum += (x - s.mean) * (x - s.mean);
                const std::uint64_t k = key_of(x);
                if (k >> (64 - known) == key) ++counts_[k >> (64 - known - digit) & (bins - 1)];
            }
            squares += sum;
        });
        key = key << digit | take_digit(rank);
    }
    s.deviation = std::sqrt(squares / static_cast<double>(s.count));
    s.median = number_of(key);
    return s;
}

} // namespace facetmill::cells
