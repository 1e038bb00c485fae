#include "support/catch.hpp"

#include "geometry/deviation/sample_walk.hpp"

#include <algorithm>
#include <numeric>

using namespace facetmill;

TEST_CASE("every sample is of one part, and the parts are spread evenly", "[geometry]") {
    constexpr std::size_t all = MeasuredSamples::all_parts;
    for (const auto& [begin, end] :
         {std::pair<std::size_t, std::size_t>{0, 0}, {5, 6}, {17, 19}, {40, 400}}) {
        std::vector<std::size_t> expected(end - begin), found;
        std::iota(expected.begin(), expected.end(), begin);
        for (const auto& [first, last] :
             {std::pair<std::size_t, std::size_t>{0, 2}, {2, 2}, {2, 7}, {7, all}}) {
            const std::size_t before = found.size();
            MeasuredSamples::each_of(first, last, begin, end, [&](std::size_t i) { found.push_back(i); });
            CHECK(std::is_sorted(found.begin() + static_cast<std::ptrdiff_t>(before), found.end()));
            const double share = static_cast<double>(end - begin) * static_cast<double>(last - first) / all;
            CHECK(std::abs(static_cast<double>(found.size() - before) - share) <= 2);
        }
        std::sort(found.begin(), found.end());
        CHECK(found == expected);
    }
}
