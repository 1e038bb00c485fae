#include "support/catch.hpp"

#include "base/math/arc_tangents.hpp"
#include "base/math/inverse_normals.hpp"
#include "base/math/portable_math.hpp"
#include "base/math/random.hpp"

#include <algorithm>
#include <bit>
#include <limits>

using namespace facetmill;

namespace {

constexpr std::uint64_t points = 200000;

double between(double low, double high, std::uint64_t key) {
    return low + (high - low) * uniform(hashed(17, key));
}

/// The largest value of error(key) over many keys.
template <class ErrorOf>
double worst(ErrorOf&& error) {
    double most = 0;
    for (std::uint64_t i = 0; i < points; ++i) most = std::max(most, static_cast<double>(error(i)));
    return most;
}

} // namespace

TEST_CASE("sine and cosine keep their accuracy up to 1e5", "[base]") {
    CHECK(worst([](auto i) {
              const double x = between(-1e5, 1e5, i);
              return std::abs(static_cast<long double>(sine(x)) - std::sin(static_cast<long double>(x)));
          }) < 1e-15);
    CHECK(worst([](auto i) {
              const double x = i % 2 ? between(-1e5, 1e5, i) : between(-10, 10, i);
              return std::abs(static_cast<long double>(cosine(x)) - std::cos(static_cast<long double>(x)));
          }) < 1e-15);
}

TEST_CASE("sine and cosine at multiples of a quarter turn", "[base]") {
    for (int k = -40000; k <= 40000; k += 7) {
        const double x = k * (pi / 2);
        CHECK(std::abs(sine(x) - static_cast<double>(std::sin(static_cast<long double>(x)))) < 1e-15);
        CHECK(std::abs(cosine(x) - static_cast<double>(std::cos(static_cast<long double>(x)))) < 1e-15);
    }
    CHECK(std::signbit(sine(-0.0)));
    CHECK(cosine(0) == 1);
    CHECK(std::isnan(sine(HUGE_VAL)));
    CHECK(std::abs(sine(1e300)) <= 1);
}

TEST_CASE("exponential keeps its relative accuracy", "[base]") {
    CHECK(worst([](auto i) {
              const double x = i % 2 ? between(-700, 700, i) : between(-2, 2, i);
              const long double exact = std::exp(static_cast<long double>(x));
              return std::abs((exponential(x) - exact) / exact);
          }) < 4e-16);
    CHECK(exponential(0) == 1);
    CHECK(exponential(701) == HUGE_VAL);
    CHECK(exponential(-701) == 0);
}

TEST_CASE("logarithm keeps its relative accuracy, near one too", "[base]") {
    CHECK(worst([](auto i) {
              const double x = i % 3 == 0   ? between(0, 1e6, i)
                               : i % 3 == 1 ? between(0.5, 2, i)
                                            : exponential(between(-690, 690, i));
              const long double exact = std::log(static_cast<long double>(x));
              return exact == 0 ? 0 : std::abs((logarithm(x) - exact) / exact);
          }) < 4e-16);
    CHECK(logarithm(1) == 0);
    CHECK(logarithm(0) == -HUGE_VAL);
    CHECK(std::isnan(logarithm(-1)));
}

TEST_CASE("arc_tangent and arc_cosine keep their accuracy in all quadrants", "[base]") {
    CHECK(worst([](auto i) {
              const double y = between(-1, 1, 2 * i), x = between(-1, 1, 2 * i + 1) * (i % 5 == 0 ? 1e-6 : 1);
              return std::abs(arc_tangent(y, x) -
                              std::atan2(static_cast<long double>(y), static_cast<long double>(x)));
          }) < 1e-15);
    CHECK(worst([](auto i) {
              const double x = i % 2 ? between(-1, 1, i) : 1 - between(0, 1e-6, i);
              return std::abs(arc_cosine(x) - std::acos(static_cast<long double>(x)));
          }) < 2e-15);
    for (const double y : {0.0, -0.0, 1.0, -1.0, HUGE_VAL, -HUGE_VAL})
        for (const double x : {0.0, -0.0, 1.0, -1.0, HUGE_VAL, -HUGE_VAL}) {
            CHECK(std::abs(arc_tangent(y, x) - std::atan2(y, x)) < 1e-15);
            CHECK(std::signbit(arc_tangent(y, x)) == std::signbit(std::atan2(y, x)));
        }
    CHECK(arc_cosine(1.5) == 0);
}

TEST_CASE("arc tangents side by side are those one by one, to the last bit", "[base]") {
    std::vector<double> y, x;
    for (double a = -40; a < 40; a += 0.37)
        for (const double b : {-1e9, -3.0, -1.0, -1e-7, -0.0, 0.0, 1e-200, 0.5, 1.0, a, 2e5}) {
            y.push_back(a);
            x.push_back(b);
        }
    std::vector<double> angles(y.size());
    arc_tangents(y, x, angles);
    for (std::size_t i = 0; i < y.size(); ++i) CHECK(angles[i] == arc_tangent(y[i], x[i]));
    arc_tangents(y, x, y); // the result may replace the input
    CHECK(y == angles);
}

TEST_CASE("inverse_normal keeps its relative accuracy from the middle to the tails", "[base]") {
    CHECK(worst([](auto i) {
              const double p = i % 4 == 0   ? between(0, 1, i)
                               : i % 4 == 1 ? 0.5 + between(-1e-3, 1e-3, i)
                               : i % 4 == 2 ? exponential(between(-600, 0, i))
                                            : 1 - between(0, 1e-9, i);
              const long double x = inverse_normal(p);
              // Newton's step from x with the long double erfc is the error of x.
              const long double root2 = std::sqrt(2.0L),
                                density = std::exp(-x * x / 2) / std::sqrt(2 * std::acos(-1.0L));
              const long double excess = p < 0.4 ? std::erfc(-x / root2) / 2 - p
                                         : p > 0.6
                                             ? (1 - static_cast<long double>(p)) - std::erfc(x / root2) / 2
                                             : std::erf(x / root2) / 2 - (static_cast<long double>(p) - 0.5L);
              return std::abs(excess / density / x);
          }) < 1e-13);
    CHECK(inverse_normal(0.5) == 0);
    CHECK(inverse_normal(0.25) == -inverse_normal(0.75));
    CHECK(inverse_normal(0) == -HUGE_VAL);
    CHECK(inverse_normal(1) == HUGE_VAL);
}

TEST_CASE("inverse_normals are inverse_normal's bits, side by side", "[base]") {
    std::vector<double> p{0, 1, 0.5, -1, 2, 0.02425, 1 - 0.02425, std::numeric_limits<double>::quiet_NaN()};
    for (double d = 1e-17; d < 0.4; d *= 1.01)
        for (const double near : {0.5 - d, 0.5 + d, 0.02425 + d, 0.02425 - d / 20, 1 - 0.02425 - d, d, 1 - d})
            p.push_back(near);
    for (std::uint64_t i = 0; i < 30001; ++i) p.push_back(uniform(hashed(9, i)));
    std::vector<double> x(p.size());
    inverse_normals(p, x);
    const auto same = [](double a, double b) {
        return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (a != a && b != b);
    };
    for (std::size_t i = 0; i < p.size(); ++i) {
        INFO(p[i]);
        CHECK(same(x[i], inverse_normal(p[i])));
    }
    inverse_normals(p, p); // the result may replace the input
    CHECK(std::equal(p.begin(), p.end(), x.begin(), same));
}
#include <vector>
