#include "cells/storage/number_file.hpp"

#include "support/catch.hpp"
#include "support/temporary.hpp"

#include <limits>

using namespace facetmill;

namespace {

void check_numbers(const std::vector<double>& numbers) {
    const test::TemporaryDirectory folder;
    cells::NumberFile file(folder.path());
    const std::size_t half = numbers.size() / 2;
    file.add(std::span(numbers).first(half));
    file.add(std::span(numbers).subspan(half));
    const Statistics a = file.statistics(), b = statistics(numbers);
    CHECK(a.count == b.count);
    CHECK(a.minimum == b.minimum);
    CHECK(a.maximum == b.maximum);
    CHECK(a.median == b.median);
    CHECK(a.mean == Approx(b.mean).margin(1e-12));
    CHECK(a.deviation == Approx(b.deviation).margin(1e-12));
}

} // namespace

TEST_CASE("numbers in a file have the statistics that they have in memory", "[cells]") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    check_numbers({});
    check_numbers({3});
    check_numbers({-0.0, 0.0, -1, infinity, std::nan("")});
    check_numbers({1, 2, 3, 4});
    check_numbers({-5e-324, 5e-324, -1e300, 1e300, 0});
    std::vector<double> many, alike(100000, 0.1);
    std::uint64_t state = 1;
    for (int i = 0; i < 100001; ++i) {
        state = state * 6364136223846793005 + 1442695040888963407;
        many.push_back(static_cast<double>(static_cast<std::int64_t>(state)) / 9.3e18);
    }
    check_numbers(many);
    check_numbers(alike);
}
