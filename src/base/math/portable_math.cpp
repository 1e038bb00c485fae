#include "base/math/portable_math.hpp"

#include "base/math/arc_tangents.hpp"
#include "base/math/inverse_normals.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace facetmill {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The polynomial c[0] + x (c[1] + x (c[2] + ...)), evaluated from the highest coefficient.
template <class Real, std::size_t N>
constexpr Real polynomial(const Real& x, const double (&c)[N]) {
    Real sum = c[N - 1];
    for (std::size_t i = N - 1; i-- > 0;) sum = sum * x + c[i];
    return sum;
}

/// An angle as quarter turns and a remainder in two parts: |high| <= pi / 4.
struct Reduced {
    double high, low;
    unsigned quadrant;
};

/// pi / 2 in three parts of 33 bits, whose products with counts below 2^20 are exact (W. J. Cody and W.
/// Waite, "Software manual for the elementary functions", 1980).
Reduced reduce(double x) {
    constexpr double part1 = 0x1.921fb544p+0, part2 = 0x1.0b4611a6p-34, part3 = 0x1.3198a2e037073p-69;
    if (std::abs(x) > 1e6) x = std::fmod(x, 4 * (part1 + part2)); // exact, though the modulus is rounded
    const double n = std::floor(x * (2 / pi) + 0.5);
    const double a = x - n * part1, b = n * part2, high = a - b, rounding = (a - high) - b;
    const double low = rounding - n * part3, sum = high + low;
    return {sum, (high - sum) + low, static_cast<unsigned>(static_cast<std::int64_t>(n)) & 3u};
}

// The Taylor series; for |x| <= pi / 4 the truncation error is below 1e-19.
double sine_series(double x, double low) {
    constexpr double c[] = {-1.0 / 6,        1.0 / 120,         -1.0 / 5040,         1.0 / 362880,
                            -1.0 / 39916800, 1.0 / 6227020800., -1.0 / 1307674368e3, 1.0 / 355687428096e3};
    const double z = x * x;
    return x + (x * z * polynomial(z, c) + low * (1 - z / 2));
}

double cosine_series(double x, double low) {
    constexpr double c[] = {
        1.0 / 24,         -1.0 / 720,          1.0 / 40320,         -1.0 / 3628800,
        1.0 / 479001600., -1.0 / 87178291200., 1.0 / 20922789888e3, -1.0 / 6402373705728e3};
    const double z = x * x, half = z / 2, one = 1 - half;
    return one + (((1 - one) - half) + (z * z * polynomial(z, c) - x * low));
}

double of_quadrant(const Reduced& r, unsigned quadrant) {
    const double v = quadrant & 1 ? cosine_series(r.high, r.low) : sine_series(r.high, r.low);
    return quadrant & 2 ? -v : v;
}

} // namespace

double sine(double x) {
    if (!std::isfinite(x)) return not_a_number;
    if (std::abs(x) < 1e-8) return x; // keeps -0 too
    const Reduced r = reduce(x);
    return of_quadrant(r, r.quadrant);
}

double cosine(double x) {
    if (!std::isfinite(x)) return not_a_number;
    const Reduced r = reduce(x);
    return of_quadrant(r, (r.quadrant + 1) & 3u);
}

namespace {

constexpr double ln2_high = 0x1.62e42feep-1,
                 ln2_low = 0x1.a39ef35793c76p-33; // high: 32 bits, so n * high is exact

/// x in powers of 2, plus 1/2: its floor is the n in exp(x) = 2^n exp(rest).
template <class Real>
Real in_powers_of_2(const Real& x) {
    return x * (1 / (ln2_high + ln2_low)) + 0.5;
}

/// exp(x) / 2^n for this n.
template <class Real>
Real exponential_of_rest(const Real& x, const Real& n) {
    const Real high = x - n * ln2_high, low = n * ln2_low, r = high - low, rest = (high - r) - low;
    constexpr double c[] = {1.0 / 2,           1.0 / 6,         1.0 / 24,         1.0 / 120,
                            1.0 / 720,         1.0 / 5040,      1.0 / 40320,      1.0 / 362880,
                            1.0 / 3628800.,    1.0 / 39916800., 1.0 / 479001600., 1.0 / 6227020800.,
                            1.0 / 87178291200.};
    return 1 + (r + (r * r * polynomial(r, c) + rest));
}

/// exp over the whole range of doubles; no result is subnormal for x >= -708.
double exponential_unlimited(double x) {
    const double n = std::floor(in_powers_of_2(x)), e = exponential_of_rest(x, n);
    if (n < -1021) return std::ldexp(e, static_cast<int>(n)); // the result may be subnormal
    return e * std::bit_cast<double>(static_cast<std::uint64_t>(static_cast<std::int64_t>(n) + 1023)
                                     << 52); // exact
}

} // namespace

double exponential(double x) {
    if (std::isnan(x)) return x;
    if (x > 700) return infinity;
    return x < -700 ? 0 : exponential_unlimited(x);
}

double logarithm(double x) {
    if (std::isnan(x) || x < 0) return not_a_number;
    if (x == 0) return -infinity;
    if (x == infinity) return x;
    int exponent = 0;
    double m = std::frexp(x, &exponent); // [0.5, 1), exact
    if (m < 0.70710678118654752440) {
        m *= 2;
        --exponent;
    }
    // log(1 + f) = 2 artanh(s), s = f / (2 + f), in the form f - (f^2/2 - s (f^2/2 + R)), which keeps
    // precision near 1.
    constexpr double c[] = {2.0 / 3,  2.0 / 5,  2.0 / 7,  2.0 / 9,  2.0 / 11,
                            2.0 / 13, 2.0 / 15, 2.0 / 17, 2.0 / 19, 2.0 / 21};
    const double f = m - 1, s = f / (2 + f), z = s * s, half = f * f / 2, rest = z * polynomial(z, c),
                 n = exponent;
    return n * ln2_high - ((half - (s * (half + rest) + n * ln2_low)) - f);
}

namespace {

/// atan(t) for 0 <= t <= 1: the angle of the nearest quarter, plus the series of the remainder (|u| <= 1/8).
double arc_tangent_series(double t) {
    constexpr double angles[] = {0, 0.24497866312686415417, 0.46364760900080611621, 0.64350110879328438680,
                                 pi / 4};
    const double beyond = t * 4 + 0.5; // t >= 0: truncated, it is t * 4, rounded
    const auto quarter = static_cast<std::size_t>(beyond);
    const double c = static_cast<double>(quarter) / 4, u = (t - c) / (1 + t * c), z = u * u;
    constexpr double k[] = {-1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11, 1.0 / 13, -1.0 / 15, 1.0 / 17};
    return angles[quarter] + (u + u * z * polynomial(z, k));
}

/// The angle of (x, y), whose smaller coordinate is t times the larger one, by amount.
double angle_of(double t, double y, double x) {
    double angle = arc_tangent_series(t);
    if (std::abs(y) > std::abs(x)) angle = pi / 2 - angle;
    if (std::signbit(x)) angle = pi - angle;
    return std::copysign(angle, y);
}

} // namespace

void arc_tangents(std::span<const double> y, std::span<const double> x, std::span<double> angles) {
    for (std::size_t i = 0; i < angles.size(); ++i) {
        const double ax = std::abs(x[i]), ay = std::abs(y[i]);
        angles[i] = angle_of(std::min(ax, ay) / std::max(ax, ay), y[i], x[i]);
    }
}

double arc_tangent(double y, double x) {
    if (std::isnan(x) || std::isnan(y)) return not_a_number;
    const double ax = std::abs(x), ay = std::abs(y), small = std::min(ax, ay), large = std::max(ax, ay);
    // Equal infinities are at 45 degrees. Two zeros are on the x axis, by the signs of both, as in atan2.
    const double t = large == 0 ? 0 : std::isinf(large) ? (std::isinf(small) ? 1 : 0) : small / large;
    return angle_of(t, y, x);
}

double arc_cosine(double x) {
    if (std::isnan(x)) return x;
    x = std::min(1.0, std::max(-1.0, x));
    return arc_tangent(std::sqrt((1 - x) * (1 + x)), x);
}

namespace {

constexpr double tail = 0.02425; // below this, another approximation is used

/// Rational approximations of the quantile for 0 < p <= 1/2 with a relative error of 1.2e-9: P. J. Acklam,
/// "An algorithm for computing the inverse normal cumulative distribution function" (2003). This function
/// covers the middle, p >= tail; q: p - 1/2.
template <class Real>
Real rough_middle(const Real& q) {
    constexpr double a[] = {2.506628277459239e+00,  -3.066479806614716e+01, 1.383577518672690e+02,
                            -2.759285104469687e+02, 2.209460984245205e+02,  -3.969683028665376e+01};
    constexpr double b[] = {1,
                            -1.328068155288572e+01,
                            6.680131188771972e+01,
                            -1.556989798598866e+02,
                            1.615858368580409e+02,
                            -5.447609879822406e+01};
    const Real r = q * q;
    return q * polynomial(r, a) / polynomial(r, b);
}

/// The approximation for all p.
double rough_quantile(double p) {
    constexpr double c[] = {2.938163982698783e+00,  4.374664141464968e+00,  -2.549732539343734e+00,
                            -2.400758277161838e+00, -3.223964580411365e-01, -7.784894002430293e-03};
    constexpr double d[] = {1, 3.754408661907416e+00, 2.445134137142996e+00, 3.224671290700398e-01,
                            7.784695709041462e-03};
    if (p >= tail) return rough_middle(p - 0.5);
    const double q = std::sqrt(-2 * logarithm(p));
    return polynomial(q, c) / polynomial(q, d);
}

bool any(bool truth) { return truth; }

/// P(0 < N < x) for 0 <= x < 2.5: x phi(x) (1 + x^2/3 + x^4/(3 5) + ...), all terms positive.
template <class Real>
Real central_probability(const Real& x, const Real& density) {
    Real term = x, sum = x;
    for (int k = 3; any(term > sum * 1e-17); k += 2) sum = sum + (term = term * (x * x / k));
    return sum * density;
}

/// P(N > x) for x >= 2: phi(x) / (x + 1/(x + 2/(x + 3/...))), with enough levels for 1e-16.
double tail_probability(double x, double density) {
    double fraction = x;
    for (int k = 120; k > 0; --k) fraction = x + k / fraction;
    return density / fraction;
}

/// The quantile of the lower half: p <= 1/2. One step of Halley's method takes 1e-9 to 1e-18.
double lower_quantile(double p) {
    const double x = -rough_quantile(p), sure = std::abs(x);
    const double density = exponential_unlimited(-x * x / 2) * 0.39894228040143267794;
    // The difference P(N < -sure) - p; near the middle computed from the differences to one half.
    const double excess =
        sure < 2.2 ? (0.5 - p) - central_probability(sure, density) : tail_probability(sure, density) - p;
    const double step = excess / density; // Newton's step, for x -> x - f / f'
    return -sure - step / (1 + -sure * step / 2);
}

} // namespace

double inverse_normal(double p) {
    if (!(p > 0)) return p == 0 ? -infinity : not_a_number;
    if (!(p < 1)) return p == 1 ? infinity : not_a_number;
    if (p == 0.5) return 0;
    return p < 0.5 ? lower_quantile(p) : -lower_quantile(1 - p);
}

namespace {

using Two = double __attribute__((vector_size(16)));
using Truths = std::int64_t __attribute__((vector_size(16)));

/// Four numbers with the same arithmetic: processing one at a time would mostly wait for the previous
/// operation.
struct Lanes {
    Two a, b;

    Lanes(double x) : a{x, x}, b{x, x} {} // NOLINT(google-explicit-constructor): as numbers are
    Lanes(const Two& first, const Two& second) : a(first), b(second) {}
    friend Lanes operator+(const Lanes& x, const Lanes& y) { return {x.a + y.a, x.b + y.b}; }
    friend Lanes operator-(const Lanes& x, const Lanes& y) { return {x.a - y.a, x.b - y.b}; }
    friend Lanes operator*(const Lanes& x, const Lanes& y) { return {x.a * y.a, x.b * y.b}; }
    friend Lanes operator/(const Lanes& x, const Lanes& y) { return {x.a / y.a, x.b / y.b}; }
    Lanes operator-() const { return {-a, -b}; }
};

struct LaneTruths {
    Truths a, b;
};
LaneTruths operator>(const Lanes& x, const Lanes& y) { return {x.a > y.a, x.b > y.b}; }
bool any(const LaneTruths& t) {
    const Truths either = t.a | t.b;
    return (either[0] | either[1]) != 0;
}

/// The value `below` for lanes with t below x, otherwise `other`.
Lanes choose_below(const Lanes& t, double x, double below, double other) {
    const Lanes there = below, elsewhere = other, edge = x;
    return {t.a < edge.a ? there.a : elsewhere.a, t.b < edge.b ? there.b : elsewhere.b};
}

Lanes absolute(const Lanes& x) { return {x.a < 0 ? -x.a : x.a, x.b < 0 ? -x.b : x.b}; }

/// Like exponential_unlimited, for -2.4 < x <= 0.
Lanes exponential(const Lanes& x) {
    const Lanes t = in_powers_of_2(x); // above -3
    const Lanes n = choose_below(t, 0, -1, 0) + choose_below(t, -1, -1, 0) + choose_below(t, -2, -1, 0);
    const Lanes power =
        choose_below(t, 0, 0.5, 1) * choose_below(t, -1, 0.5, 1) * choose_below(t, -2, 0.5, 1);
    return exponential_of_rest(x, n) * power;
}

/// Like lower_quantile, for tail <= p < 1/2, which means |x| < 2. A lane whose series has converged continues
/// with the others: its decreasing terms are too small to change its sum.
Lanes middle_quantiles(const Lanes& p) {
    const Lanes x = -rough_middle(p - 0.5), sure = absolute(x);
    const Lanes density = exponential(-x * x / 2) * 0.39894228040143267794;
    const Lanes excess = (0.5 - p) - central_probability(sure, density);
    const Lanes step = excess / density;
    return -sure - step / (1 + -sure * step / 2);
}

/// Collects numbers until there are four.
class Waiting {
  public:
    explicit Waiting(std::span<double> x) : x_(x) {}

    void add(double p, std::size_t place) {
        is_upper_[count_] = p > 0.5;
        lower_[count_] = p > 0.5 ? 1 - p : p;
        place_[count_++] = place;
        if (count_ == 4) finish();
    }
    void finish() {
        const Lanes found = middle_quantiles({Two{lower_[0], lower_[1]}, Two{lower_[2], lower_[3]}});
        const double all[] = {found.a[0], found.a[1], found.b[0], found.b[1]};
        for (std::size_t i = 0; i < count_; ++i) x_[place_[i]] = is_upper_[i] ? -all[i] : all[i];
        count_ = 0;
    }

  private:
    std::span<double> x_;
    double lower_[4] = {0.25, 0.25, 0.25, 0.25};
    std::size_t place_[4] = {};
    bool is_upper_[4] = {};
    std::size_t count_ = 0;
};

} // namespace

void inverse_normals(std::span<const double> p, std::span<double> x) {
    Waiting waiting(x);
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double here = p[i];
        const bool in_middle = here != 0.5 && here >= tail && 1 - here >= tail;
        if (in_middle)
            waiting.add(here, i);
        else
            x[i] = inverse_normal(here);
    }
    waiting.finish();
}

} // namespace facetmill
