#include "geometry/measure/statistics.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill {

namespace {

template <class Map>
double sum_of(const std::vector<double>& numbers, Map&& map) {
    return parallel_reduce(
        numbers.size(), 0.0,
        [&](std::size_t begin, std::size_t end) {
            double sum = 0;
            for (std::size_t i = begin; i < end; ++i) sum += map(numbers[i]);
            return sum;
        },
        [](double a, double b) { return a + b; });
}

} // namespace

Statistics statistics(std::vector<double> numbers) {
    std::erase_if(numbers, [](double x) { return !std::isfinite(x); });
    Statistics s;
    s.count = numbers.size();
    if (numbers.empty()) return s;
    const auto count = static_cast<double>(s.count);
    const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
    s.minimum = *low;
    s.maximum = *high;
    s.sum = sum_of(numbers, [](double x) { return x; });
    s.mean = s.sum / count;
    const double mean = s.mean;
    s.deviation = std::sqrt(sum_of(numbers, [mean](double x) { return (x - mean) * (x - mean); }) / count);
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(s.count / 2);
    std::nth_element(numbers.begin(), middle, numbers.end());
    s.median = *middle;
    return s;
}

} // namespace facetmill
