#include "io/gltf/numbers/quantise.hpp"

#include "base/math/numbers.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/encode/encode.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

/// Rounds to nearest, and halves away from zero.
double to_nearest(double x) { return x < 0 ? -std::floor(0.5 - x) : std::floor(x + 0.5); }

/// True if of(i) is true for all i below count.
template <class Of>
bool holds_for_all(std::size_t count, Of&& of) {
    return parallel_reduce(
               count, 1,
               [&](std::size_t begin, std::size_t end) {
                   while (begin < end && of(begin)) ++begin;
                   return begin == end ? 1 : 0;
               },
               [](int x, int y) { return std::min(x, y); }) != 0;
}

/// The numbers of an attribute, converted one by one. None if `of` fails for a number.
template <class T, class Of>
std::optional<std::vector<T>> each_number(const Attribute& a, Of&& of) {
    const std::size_t width = static_cast<std::size_t>(a.components);
    std::vector<T> out(a.size() * width);
    const bool all = holds_for_all(a.size(), [&](std::size_t i) {
        for (std::size_t c = 0; c < width; ++c)
            if (!of(a.value(i, static_cast<int>(c)), out[i * width + c])) return false;
        return true;
    });
    return all ? std::optional(std::move(out)) : std::nullopt;
}

/// The largest absolute value; infinity if a number is not finite.
double largest_of(const Attribute& a) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < a.components; ++c) {
            const double x = std::abs(a.value(i, c));
            most = x <= HUGE_VAL ? std::max(most, x) : HUGE_VAL;
        }
    return most;
}

/// Rounds fractions to 2^bits - 1 steps, scaled to the range of T.
template <class T>
std::optional<Stored> stepped(const Attribute& a, double steps, double least) {
    constexpr double most = std::numeric_limits<T>::max();
    const auto data = each_number<T>(a, [&](double x, T& out) {
        const bool within = x >= least && x <= 1;
        out = within ? static_cast<T>(to_nearest(to_nearest(x * steps) / steps * most)) : T{0};
        return within;
    });
    if (!data) return {};
    return plain(*data, a.components, true, false);
}

template <class T>
Stored octahedral_as(const Attribute& a, int bits) {
    const double steps = static_cast<double>((1 << (bits - 1)) - 1);
    std::vector<T> out(4 * a.size());
    parallel_for(a.size(), [&](std::size_t i) {
        const double x = a.value(i, 0), y = a.value(i, 1), z = a.value(i, 2);
        const double sum = std::abs(x) + std::abs(y) + std::abs(z);
        double u = sum > 0 ? x / sum : 0, v = sum > 0 ? y / sum : 0;
        if (z < 0) { // the lower half is folded outwards
            const double folded = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
            v = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
            u = folded;
        }
        out[4 * i] = static_cast<T>(to_nearest(u * steps));
        out[4 * i + 1] = static_cast<T>(to_nearest(v * steps));
        out[4 * i + 2] = static_cast<T>(steps);
        const T most = std::numeric_limits<T>::max();
        out[4 * i + 3] = a.components < 4 ? T{0} : a.value(i, 3) < 0 ? static_cast<T>(-most) : most;
    });
    Stored stored = plain(out, 4, true, false);
    stored.accessor["type"] = type_name(a.components);
    if (a.components < 4) stored.stride = 4 * sizeof(T);
    stored.filter = "OCTAHEDRAL";
    return stored;
}

constexpr double root_of_two = 1.4142135623730951;

/// A quaternion in the filter's form: without its largest component, which is positive.
std::array<std::int16_t, 4> without_largest(const std::array<double, 4>& q, int bits) {
    const double steps = static_cast<double>((1 << (bits - 1)) - 1);
    std::size_t largest = 0;
    for (std::size_t c = 1; c < 4; ++c)
        if (std::abs(q[c]) > std::abs(q[largest])) largest = c;
    const double sign = q[largest] < 0 ? -1 : 1;
    std::array<std::int16_t, 4> out{};
    for (std::size_t c = 0; c < 3; ++c) {
        const double x = q[(largest + 1 + c) % 4] * sign * root_of_two * steps;
        out[c] = static_cast<std::int16_t>(std::clamp(to_nearest(x), -steps, steps));
    }
    // The filter sets the two lowest bits to find the number of steps.
    out[3] = static_cast<std::int16_t>((static_cast<int>(steps) & ~3) | static_cast<int>(largest));
    return out;
}

/// The element as a unit quaternion; none if its length differs from 1 by more than 1e-3.
std::optional<std::array<double, 4>> unit_quaternion(const Attribute& a, std::size_t i) {
    std::array<double, 4> q{};
    double sum = 0;
    for (std::size_t c = 0; c < 4; ++c) {
        q[c] = a.value(i, static_cast<int>(c));
        sum += q[c] * q[c];
    }
    const double norm = std::sqrt(sum);
    constexpr double tolerance = 1e-3; // rotations have unit length within this tolerance
    if (!(std::abs(norm - 1) <= tolerance)) return {};
    for (double& x : q) x /= norm;
    return q;
}

/// By how much rounding turns a rotation, in radians, to first order.
double turn_by_rounding(const std::array<double, 4>& q, int bits) {
    const auto stored = without_largest(q, bits);
    const double step = 1 / (root_of_two * static_cast<double>((1 << (bits - 1)) - 1));
    const auto largest = static_cast<std::size_t>(stored[3] & 3);
    std::array<double, 4> back{};
    double rest = 1;
    for (std::size_t c = 0; c < 3; ++c) {
        const double x = stored[c] * step;
        back[(largest + 1 + c) % 4] = x;
        rest -= x * x;
    }
    back[largest] = std::sqrt(std::max(rest, 0.0));
    const double sign = q[largest] < 0 ? -1 : 1;
    double sum = 0;
    for (std::size_t c = 0; c < 4; ++c) sum += (back[c] * sign - q[c]) * (back[c] * sign - q[c]);
    return 2 * std::sqrt(sum);
}

/// Distributes `whole` in proportion to the weights, so that the shares sum to it.
void share_out(const std::vector<double>& weights, std::uint32_t whole, std::vector<std::uint32_t>& shares) {
    shares.assign(weights.size(), 0);
    double sum = 0;
    for (const double w : weights) sum += w;
    if (!(sum > 0)) shares[0] = whole; // such vertices follow their first joint, as in three.js
    if (!(sum > 0) || !(sum < HUGE_VAL)) return;
    std::vector<std::pair<double, std::size_t>> rest; // negated remainders, so that the largest comes first
    std::uint32_t given = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double exact = weights[i] / sum * whole;
        shares[i] = static_cast<std::uint32_t>(std::floor(exact));
        given += shares[i];
        if (weights[i] > 0) rest.emplace_back(static_cast<double>(shares[i]) - exact, i);
    }
    std::sort(rest.begin(), rest.end());
    for (std::size_t k = 0; given < whole; ++k, ++given) ++shares[rest[k % rest.size()].second];
}

/// The joints of a vertex with their shares, largest first.
using Influence = std::pair<std::uint32_t, std::uint32_t>; // share, joint

void sort_influences(std::vector<Influence>& all) {
    std::sort(all.begin(), all.end(), [](const Influence& a, const Influence& b) {
        return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
}

template <class Weight, class Joint>
StoredInfluences influences_as(const Influences& all) {
    const std::size_t sets = all.weights.size(), count = all.weights.front().size();
    std::vector<std::vector<Weight>> weights(sets, std::vector<Weight>(4 * count));
    std::vector<std::vector<Joint>> joints(sets, std::vector<Joint>(4 * count));
    parallel_chunks(count, [&](std::size_t begin, std::size_t end) {
        std::vector<double> given(4 * sets);
        std::vector<std::uint32_t> shares;
        std::vector<Influence> of_vertex(4 * sets);
        for (std::size_t i = begin; i < end; ++i) {
            for (std::size_t k = 0; k < given.size(); ++k)
                given[k] = std::max(0.0, all.weights[k / 4].value(i, static_cast<int>(k % 4)));
            share_out(given, std::numeric_limits<Weight>::max(), shares);
            for (std::size_t k = 0; k < of_vertex.size(); ++k) {
                const double joint = all.joints[k / 4].value(i, static_cast<int>(k % 4));
                of_vertex[k] = {shares[k], shares[k] > 0 ? static_cast<std::uint32_t>(joint) : 0};
            }
            sort_influences(of_vertex);
            for (std::size_t k = 0; k < of_vertex.size(); ++k) {
                weights[k / 4][4 * i + k % 4] = static_cast<Weight>(of_vertex[k].first);
                joints[k / 4][4 * i + k % 4] = static_cast<Joint>(of_vertex[k].second);
            }
        }
    });
    StoredInfluences stored;
    for (auto& w : weights) stored.weights.push_back(plain(w, 4, true, false));
    for (auto& j : joints) stored.joints.push_back(plain(j, 4, false, false));
    return stored;
}

} // namespace

double short_above(double x) {
    const auto digits = [](double y) { return parse_real(fmt::format("{:.7e}", y)).value_or(y); };
    const double near = digits(x);
    return near >= x ? near : digits(x * (1 + 1e-7)); // otherwise the next larger number in the last digit
}

double short_near(double x, double step) {
    if (!(step > 0) || !(step < HUGE_VAL)) return x;
    constexpr std::size_t longest = 400; // 1e308 with 16 decimals
    std::array<char, longest> text;
    for (int decimals = 0; decimals < 17; ++decimals) {
        const auto written =
            std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::fixed, decimals);
        const double near = parse_real({text.data(), written.ptr}).value_or(x);
        if (std::abs(near - x) <= step / 100) return near + 0.0;
    }
    return x;
}

Stored plain(const AttributeData& data, int components, bool normalised, bool bounds) {
    Stored stored{accessor_json(data, components, normalised, bounds), {}};
    std::visit(
        [&](const auto& numbers) {
            const std::size_t width = static_cast<std::size_t>(components);
            const std::size_t size = sizeof(numbers[0]) * width, count = numbers.size() / width,
                              padded = (size + 3) / 4 * 4;
            if (padded != size) stored.stride = padded;
            stored.bytes.resize(count * padded);
            const auto* from = reinterpret_cast<const std::byte*>(numbers.data());
            parallel_for(
                count, [&](std::size_t i) { std::memcpy(&stored.bytes[i * padded], from + i * size, size); });
        },
        data);
    return stored;
}

std::optional<Stored> on_grid(const std::vector<Vec3>& positions, const PositionGrid& grid) {
    const auto as = [&](auto zero) -> std::optional<Stored> {
        using T = decltype(zero);
        std::vector<T> out(3 * positions.size());
        const bool all = holds_for_all(positions.size(), [&](std::size_t i) {
            for (std::size_t c = 0; c < 3; ++c) {
                const double n = to_nearest((positions[i][c] - grid.origin[c]) / grid.step);
                if (!(n >= 0 && n <= std::numeric_limits<T>::max())) return false;
                out[3 * i + c] = static_cast<T>(n);
            }
            return true;
        });
        if (!all) return {};
        return plain(out, 3, false, true);
    };
    return grid.bits <= 8 ? as(std::uint8_t{}) : as(std::uint16_t{});
}

Stored displacements(const Attribute& deltas, const PositionGrid& grid) {
    const auto steps = each_number<std::int16_t>(deltas, [&](double x, std::int16_t& out) {
        const double n = to_nearest(x / grid.step);
        const bool fits = n >= -32767 && n <= 32767;
        out = fits ? static_cast<std::int16_t>(n) : std::int16_t{0};
        return fits;
    });
    if (steps) return plain(*steps, 3, false, true);
    const auto floats = each_number<float>(deltas, [&](double x, float& out) {
        out = static_cast<float>(x / grid.step);
        return true;
    });
    return plain(*floats, 3, false, true);
}

std::optional<Stored> signed_fractions(const Attribute& a, int bits) {
    const double steps = static_cast<double>((1 << (bits - 1)) - 1);
    return bits <= 8 ? stepped<std::int8_t>(a, steps, -1) : stepped<std::int16_t>(a, steps, -1);
}

std::optional<Stored> fractions(const Attribute& a, int bits) {
    const double steps = static_cast<double>((1 << bits) - 1);
    return bits <= 8 ? stepped<std::uint8_t>(a, steps, 0) : stepped<std::uint16_t>(a, steps, 0);
}

Stored octahedral(const Attribute& a, int bits) {
    return bits <= 8 ? octahedral_as<std::int8_t>(a, bits) : octahedral_as<std::int16_t>(a, bits);
}

std::optional<Stored> quaternions(const Attribute& a, int bits) {
    std::vector<std::int16_t> out(4 * a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        const auto q = unit_quaternion(a, i);
        if (!q) return {};
        const auto four = without_largest(*q, bits);
        std::copy(four.begin(), four.end(), out.begin() + static_cast<std::ptrdiff_t>(4 * i));
    }
    Stored stored = plain(out, 4, true, false);
    stored.filter = "QUATERNION";
    return stored;
}

int bits_of_turns(const Attribute& a, double angle) {
    constexpr int fewest = 6, most = 16;
    const auto fits = [&](int bits) {
        for (std::size_t i = 0; i < a.size(); ++i)
            if (const auto q = unit_quaternion(a, i); !q || !(turn_by_rounding(*q, bits) <= angle))
                return false;
        return true;
    };
    int bits = fewest;
    while (bits < most && !fits(bits)) ++bits;
    return bits;
}

std::optional<Stored> exponential(const Attribute& a, int exponent, bool bounds) {
    constexpr double reach = 1 << 23;
    if (exponent < -100 || exponent > 100) return {};
    std::vector<float> decoded(a.size() * static_cast<std::size_t>(a.components));
    const auto words = each_number<std::uint32_t>(a, [&](double x, std::uint32_t& out) {
        const double n = to_nearest(std::ldexp(x, -exponent));
        if (!(std::abs(n) < reach)) return false;
        out = static_cast<std::uint32_t>(exponent) << 24 |
              (static_cast<std::uint32_t>(static_cast<std::int32_t>(n)) & 0xFFFFFF);
        return true;
    });
    if (!words) return {};
    for (std::size_t i = 0; i < decoded.size(); ++i) {
        const auto n = static_cast<std::int32_t>((*words)[i] << 8) >> 8;
        decoded[i] = static_cast<float>(std::ldexp(static_cast<double>(n), exponent));
    }
    Stored stored = plain(decoded, a.components, false, bounds);
    std::memcpy(stored.bytes.data(), words->data(), stored.bytes.size());
    stored.filter = "EXPONENTIAL";
    return stored;
}

int finest_exponent(const Attribute& a) {
    const double most = largest_of(a);
    if (!(most > 0) || !(most < HUGE_VAL)) return 0;
    const int exponent = std::ilogb(most) - 22;
    return std::max(-100, to_nearest(std::ldexp(most, -exponent)) < 1 << 23 ? exponent : exponent + 1);
}

int exponent_of_range(const Attribute& a, int bits) {
    double range = 0;
    for (int c = 0; c < a.components; ++c) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (std::size_t i = 0; i < a.size(); ++i) {
            low = std::min(low, a.value(i, c));
            high = std::max(high, a.value(i, c));
        }
        range = std::max(range, high - low);
    }
    if (!(range > 0) || !(range < HUGE_VAL)) return finest_exponent(a);
    return std::max(-100, std::ilogb(std::ldexp(range, -bits)));
}

StoredInfluences influences(const Influences& all, int bits) {
    double most = 0;
    for (const auto& joints : all.joints) most = std::max(most, largest_of(joints));
    const bool small = most <= 255;
    if (bits <= 8)
        return small ? influences_as<std::uint8_t, std::uint8_t>(all)
                     : influences_as<std::uint8_t, std::uint16_t>(all);
    return small ? influences_as<std::uint16_t, std::uint8_t>(all)
                 : influences_as<std::uint16_t, std::uint16_t>(all);
}

} // namespace facetmill::io::gltf
