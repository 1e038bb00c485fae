#include "diff/conversion.hpp"

#include "io/convert.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace facetmill::report {

namespace {

/// Where a scene lies: its box, and the mean of its vertices, by which turns of one box are told apart.
struct Lie {
    Box box;
    Vec3 mean;
};

Lie lie_of(const Scene& scene) {
    Lie lie{scene.bounds(), {}};
    std::size_t count = 0;
    for (const Part& part : scene.parts)
        for (const Vec3& own : part.mesh.positions)
            if (const Vec3 p = part.transform.point(own); is_finite(p)) {
                ++count;
                lie.mean += (p - lie.mean) / static_cast<double>(count);
            }
    return lie;
}

struct UnitFactor {
    double factor = 1; ///< what numbers in `to` are multiples of those in `from`
    Unit from = Unit::unknown, to = Unit::unknown;
};

/// The pair of units whose factor is nearest to the ratio, within two hundredths; units people model in come
/// first. What one of the files states, where the other states nothing, is one of the pair.
UnitFactor unit_factor(double ratio, Unit first, Unit second) {
    constexpr std::array units{Unit::mm, Unit::m, Unit::cm, Unit::inch, Unit::foot, Unit::um, Unit::km};
    const bool both = first != Unit::unknown && second != Unit::unknown;
    const auto stated_else = [&](Unit stated, Unit unit) {
        return !both && stated != Unit::unknown && stated != unit;
    };
    UnitFactor best;
    double nearest = std::abs(std::log(ratio));
    for (const Unit from : units)
        for (const Unit to : units) {
            if (stated_else(first, from) || stated_else(second, to)) continue;
            const double factor = metres(from) / metres(to);
            const double off = std::abs(std::log(ratio / factor));
            if (off < nearest - 1e-9) {
                best = {factor, from, to};
                nearest = off;
            }
        }
    return nearest < 0.02 ? best : UnitFactor{};
}

/// A turn about the axes: of the new ones each is an old one, or its opposite.
struct AxisTurn {
    std::array<std::size_t, 3> from{0, 1, 2};
    std::array<double, 3> sign{1, 1, 1};

    Vec3 of(const Vec3& p) const {
        return {sign[0] * p[from[0]], sign[1] * p[from[1]], sign[2] * p[from[2]]};
    }
    Lie of(const Lie& lie) const {
        Lie out{{}, of(lie.mean)};
        out.box.add(of(lie.box.min));
        out.box.add(of(lie.box.max));
        return out;
    }
    bool operator==(const AxisTurn&) const = default;
};

AxisTurn up_turn(UpAxis from, UpAxis to) {
    const Transform t = io::turn_up(from, to);
    AxisTurn out;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            if (t.m[row][column] != 0) {
                out.from[row] = column;
                out.sign[row] = t.m[row][column] < 0 ? -1 : 1;
            }
    return out;
}

/// None first, then those of another up axis, then all others that mirror nothing.
std::vector<AxisTurn> all_turns() {
    std::vector<AxisTurn> out{{}, up_turn(UpAxis::y, UpAxis::z), up_turn(UpAxis::z, UpAxis::y)};
    constexpr std::array<std::array<std::size_t, 3>, 6> orders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    for (std::size_t o = 0; o < orders.size(); ++o)
        for (int signs = 0; signs < 8; ++signs) {
            AxisTurn turn{orders[o], {}};
            double handed = o < 3 ? 1 : -1;
            for (std::size_t i = 0; i < 3; ++i) handed *= turn.sign[i] = signs >> i & 1 ? -1 : 1;
            if (handed > 0 && std::find(out.begin(), out.end(), turn) == out.end()) out.push_back(turn);
        }
    return out;
}

/// How far the one is from the other times the factor: the means where the boxes are within a hundredth of
/// the diagonal, corner by corner.
std::optional<double> off(const Lie& a, const Lie& b, double factor) {
    const double most = a.box.diagonal() / 100 * factor;
    if (!(length(a.box.min * factor - b.box.min) <= most && length(a.box.max * factor - b.box.max) <= most))
        return {};
    return length(a.mean * factor - b.mean);
}

/// The turn that makes the one the other, if there is one; of several the first that is clearly nearest.
std::optional<AxisTurn> turn_between(const Lie& a, const Lie& b, double factor) {
    std::optional<AxisTurn> best;
    double nearest = HUGE_VAL;
    for (const AxisTurn& turn : all_turns()) {
        const auto distance = off(turn.of(a), b, factor);
        if (!distance || !(*distance < nearest - a.box.diagonal() * factor / 1000)) continue;
        nearest = *distance;
        best = turn;
    }
    return best;
}

/// How to say that the first file has the one and the second the other.
std::string way_to_say(const char* option, const char* what, std::string_view from, std::string_view to,
                       bool first_states, bool second_states) {
    if (first_states && second_states)
        return fmt::format("both files state {}, and one seems to be wrong", what);
    if (first_states) return fmt::format("{} {} says so of the second file, which states none", option, to);
    if (second_states) return fmt::format("{} {} says so of the first file, which states none", option, from);
    return fmt::format("{} {},{} says so of the files, which state none", option, from, to);
}

void add(std::string& text, const char* joint, const std::string& more) {
    text += text.empty() ? more : joint + more;
}

/// "x, -z, y", and the matrix that makes the second file from the first.
std::string words_for(const AxisTurn& turn) {
    std::string axes, matrix;
    for (std::size_t row = 0; row < 3; ++row) {
        const char* sign = turn.sign[row] < 0 ? "-" : "";
        add(axes, ", ", fmt::format("{}{}", sign, "xyz"[turn.from[row]]));
        for (std::size_t column = 0; column < 4; ++column)
            add(matrix, ",", column == turn.from[row] ? fmt::format("{}1", sign) : "0");
    }
    return fmt::format("turned so that its x, y, z are {} (transform --matrix {})", axes, matrix);
}

std::string words_for(const UnitFactor& units, const AxisTurn& turn, const Scene& a, const Scene& b) {
    std::string how, way;
    if (units.factor != 1) {
        how = fmt::format("times {:.6g}, as from {} to {}", units.factor, to_string(units.from),
                          to_string(units.to));
        way = way_to_say("--unit", "a unit", to_string(units.from), to_string(units.to),
                         a.unit != Unit::unknown, b.unit != Unit::unknown);
    }
    const bool y_to_z = turn == up_turn(UpAxis::y, UpAxis::z);
    if (y_to_z || turn == up_turn(UpAxis::z, UpAxis::y)) {
        const UpAxis from = y_to_z ? UpAxis::y : UpAxis::z, to = y_to_z ? UpAxis::z : UpAxis::y;
        add(how, ", and ", fmt::format("turned from {} up to {} up", to_string(from), to_string(to)));
        add(way, "; ",
            way_to_say("--up", "an up axis", to_string(from), to_string(to), a.up != UpAxis::unknown,
                       b.up != UpAxis::unknown));
    } else if (turn != AxisTurn{}) {
        add(how, ", and ", words_for(turn));
    }
    return fmt::format("the box of the second file is that of the first {}{}{}", how, way.empty() ? "" : ": ",
                       way);
}

} // namespace

std::string conversion_hint(const Scene& a, const Scene& b) {
    const Lie first = lie_of(a), second = lie_of(b);
    const double size_a = first.box.diagonal(), size_b = second.box.diagonal();
    if (!(size_a > 0) || !(size_b > 0) || !std::isfinite(size_a) || !std::isfinite(size_b)) return {};
    const UnitFactor units = unit_factor(size_b / size_a, a.unit, b.unit);
    const auto turn = turn_between(first, second, units.factor);
    if (!turn || (units.factor == 1 && *turn == AxisTurn{})) return {};
    return words_for(units, *turn, a, b);
}

} // namespace facetmill::report
