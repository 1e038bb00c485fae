#pragma once
// A list of numbers in a few.

#include <cstddef>
#include <vector>

namespace facetmill {

/// All zero for no numbers.
struct Statistics {
    std::size_t count = 0;
    double minimum = 0, maximum = 0, mean = 0,
           deviation = 0; ///< deviation: the standard deviation of all of them
    double median = 0;    ///< of an even count the upper of the middle two
    double sum = 0;
};

/// Numbers that are not finite are left out. Parallel, and the same for any number of threads.
Statistics statistics(std::vector<double> numbers);

} // namespace facetmill
