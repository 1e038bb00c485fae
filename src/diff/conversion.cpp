#include "diff/conversion.hpp"

#include "base/math/portable_math.hpp"
#include "mesh/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace facetmill::report {

namespace {

/// The box of a scene, and a point in it that distinguishes rotations of the same box.
struct Lie {
    Box box;
    Vec3 middle;
};

/// A weighted mean of points.
class WeightedMean {
  public:
    void add(const Vec3& p, double weight) {
        if (!is_finite(p) || !(weight > 0) || !std::isfinite(sum_ + weight)) return;
        sum_ += weight;
        mean_ += (p - mean_) * (weight / sum_);
    }
    bool is_of_something() const { return sum_ > 0; }
    const Vec3& mean() const { return mean_; }

  private:
    double sum_ = 0;
    Vec3 mean_;
};

/// The centroid of the surface, which does not depend on how it is cut into faces.
WeightedMean mean_of_surface(const Scene& scene) {
    const Surface surface = surface_of(scene);
    WeightedMean mean;
    for (std::size_t t = 0; t < surface.size(); ++t) {
        const Vec3 &a = surface.point(t, 0), &b = surface.point(t, 1), &c = surface.point(t, 2);
        mean.add(a + ((b - a) + (c - a)) / 3, length(cross(b - a, c - a)));
    }
    return mean;
}

WeightedMean mean_of_vertices(const Scene& scene) {
    WeightedMean mean;
    for (const Part& part : scene.parts)
        for (const Vec3& own : part.mesh.positions) mean.add(part.transform.point(own), 1);
    return mean;
}

/// Uses the centroids of both surfaces, or the means of the vertices if one surface has no area.
std::pair<Lie, Lie> lies_of(const Scene& a, const Scene& b) {
    WeightedMean first = mean_of_surface(a), second = mean_of_surface(b);
    if (!first.is_of_something() || !second.is_of_something()) {
        first = mean_of_vertices(a);
        second = mean_of_vertices(b);
    }
    return {{a.bounds(), first.mean()}, {b.bounds(), second.mean()}};
}

struct UnitFactor {
    double factor = 1; ///< ratio of numbers in `to` to numbers in `from`
    Unit from = Unit::unknown, to = Unit::unknown;
};

/// The pair of units whose factor is nearest to the ratio, within two hundredths; units common in modelling
/// come first. If only one file states its unit, the pair contains it.
UnitFactor unit_factor(double ratio, Unit first, Unit second) {
    constexpr std::array units{Unit::mm, Unit::m, Unit::cm, Unit::inch, Unit::foot, Unit::um, Unit::km};
    const bool both = first != Unit::unknown && second != Unit::unknown;
    const auto stated_else = [&](Unit stated, Unit unit) {
        return !both && stated != Unit::unknown && stated != unit;
    };
    UnitFactor best;
    double nearest = std::abs(logarithm(ratio));
    for (const Unit from : units)
        for (const Unit to : units) {
            if (stated_else(first, from) || stated_else(second, to)) continue;
            const double factor = metres(from) / metres(to);
            const double off = std::abs(logarithm(ratio / factor));
            if (off < nearest - 1e-9) {
                best = {factor, from, to};
                nearest = off;
            }
        }
    return nearest < 0.02 ? best : UnitFactor{};
}

/// A rotation that maps axes to axes: each new axis is an old one, or its opposite.
struct AxisTurn {
    std::array<std::size_t, 3> from{0, 1, 2};
    std::array<double, 3> sign{1, 1, 1};

    Vec3 of(const Vec3& p) const {
        return {sign[0] * p[from[0]], sign[1] * p[from[1]], sign[2] * p[from[2]]};
    }
    Lie of(const Lie& lie) const {
        Lie out{{}, of(lie.middle)};
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

/// The identity first, then the rotations between up axes, then all other rotations.
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

/// The distance between the middles of b and of a scaled by the factor. None unless the boxes match, corner
/// by corner, within a hundredth of the diagonal.
std::optional<double> off(const Lie& a, const Lie& b, double factor) {
    const double most = a.box.diagonal() / 100 * factor;
    if (!(length(a.box.min * factor - b.box.min) <= most && length(a.box.max * factor - b.box.max) <= most))
        return {};
    return length(a.middle * factor - b.middle);
}

/// The rotation that maps a to b, if there is one: the identity if the box matches, unless the middles
/// clearly contradict. Otherwise the first of several that is clearly nearest.
std::optional<AxisTurn> turn_between(const Lie& a, const Lie& b, double factor) {
    const double diagonal = a.box.diagonal() * factor;
    const auto unturned = off(a, b, factor);
    if (unturned && *unturned <= diagonal / 100) return AxisTurn{};
    std::optional<AxisTurn> best;
    double nearest = HUGE_VAL;
    for (const AxisTurn& turn : all_turns()) {
        const auto distance = off(turn.of(a), b, factor);
        if (!distance || !(*distance < nearest - diagonal / 1000)) continue;
        nearest = *distance;
        best = turn;
    }
    return unturned && !(nearest < diagonal / 1000) ? AxisTurn{} : best;
}

/// The conversion that the command line applied to the second scene; none if both files state their
/// convention.
struct Given {
    double factor = 1;
    AxisTurn turn; ///< inverse of the applied rotation

    Lie undone(const Lie& lie) const {
        Lie out = turn.of(lie);
        out.box = {out.box.min / factor, out.box.max / factor};
        out.middle = out.middle / factor;
        return out;
    }
};

Given given_by_command_line(const Origin& origin, UpAxis up) {
    Given out;
    if (origin.a.unit == Unit::unknown || origin.b.unit == Unit::unknown)
        out.factor = origin.of_second.factor;
    if (origin.of_second.turned && (origin.a.up == UpAxis::unknown || origin.b.up == UpAxis::unknown))
        out.turn = up_turn(up, up == UpAxis::y ? UpAxis::z : UpAxis::y);
    return out;
}

/// The options that give each file its value.
std::string way_to_say(const char* option, const char* what, std::string_view from, std::string_view to,
                       bool first_states, bool second_states) {
    if (first_states && second_states)
        return fmt::format("both files state {}, and one seems to be wrong", what);
    if (first_states)
        return fmt::format("use {} {}, because the second file does not state {}", option, to, what);
    if (second_states)
        return fmt::format("use {} {}, because the first file does not state {}", option, from, what);
    return fmt::format("use {} {},{}, because neither file states {}", option, from, to, what);
}

void add(std::string& text, const char* joint, const std::string& more) {
    text += text.empty() ? more : joint + more;
}

/// "x, -z, y", and the matrix that converts the first file into the second.
std::string words_for(const AxisTurn& turn) {
    std::string axes, matrix;
    for (std::size_t row = 0; row < 3; ++row) {
        const char* sign = turn.sign[row] < 0 ? "-" : "";
        add(axes, ", ", fmt::format("{}{}", sign, "xyz"[turn.from[row]]));
        for (std::size_t column = 0; column < 4; ++column)
            add(matrix, ",", column == turn.from[row] ? fmt::format("{}1", sign) : "0");
    }
    return fmt::format("rotated so that its x, y, z become {} (transform --matrix {})", axes, matrix);
}

/// The text of a hint, and its options for the command line.
struct Words {
    std::string how, way;
};

void tell_units(const UnitFactor& units, const Given& given, const Origin& origin, Words& words) {
    if (units.factor == 1) {
        if (given.factor != 1) add(words.how, " and ", "read without --unit");
        return;
    }
    add(words.how, " and ",
        fmt::format("scaled by {:.6g} (from {} to {})", units.factor, to_string(units.from),
                    to_string(units.to)));
    add(words.way, "; ",
        way_to_say("--unit", "a unit", to_string(units.from), to_string(units.to),
                   origin.a.unit != Unit::unknown, origin.b.unit != Unit::unknown));
}

/// True if the rotation converts between up axes, and the files do not contradict.
bool is_of_up_axes(const AxisTurn& turn, UpAxis from, UpAxis to, const Origin& origin) {
    const UpAxis a = origin.a.up, b = origin.b.up;
    if (a != UpAxis::unknown && b != UpAxis::unknown) return false; // then it was already applied
    return turn == up_turn(from, to) && (a == UpAxis::unknown || a == from) &&
           (b == UpAxis::unknown || b == to);
}

/// own: the rotation between the files; now: the rotation between the compared scenes.
void tell_turn(const AxisTurn& own, const AxisTurn& now, const Given& given, const Origin& origin,
               Words& words) {
    for (const auto& [from, to] : {std::pair(UpAxis::y, UpAxis::z), std::pair(UpAxis::z, UpAxis::y)})
        if (is_of_up_axes(own, from, to, origin)) {
            add(words.how, " and ",
                fmt::format("rotated from {} up to {} up", to_string(from), to_string(to)));
            add(words.way, "; ",
                way_to_say("--up", "an up axis", to_string(from), to_string(to),
                           origin.a.up != UpAxis::unknown, origin.b.up != UpAxis::unknown));
            return;
        }
    if (own == AxisTurn{} && given.turn != AxisTurn{})
        add(words.how, " and ", "read without --up");
    else if (now != AxisTurn{})
        add(words.how, " and ", words_for(now));
}

} // namespace

std::string conversion_hint(const Scene& a, const Scene& b, const Origin& origin) {
    const auto [first, second] = lies_of(a, b);
    const double size_a = first.box.diagonal(), size_b = second.box.diagonal();
    if (!(size_a > 0) || !(size_b > 0) || !std::isfinite(size_a) || !std::isfinite(size_b)) return {};
    if (turn_between(first, second, 1) == AxisTurn{}) return {};
    const Given given = given_by_command_line(origin, b.up);
    const UnitFactor units = unit_factor(size_b / given.factor / size_a, origin.a.unit, origin.b.unit);
    const auto own = turn_between(first, given.undone(second), units.factor),
               now = turn_between(first, second, units.factor * given.factor);
    if (!own || !now) return {};
    Words words;
    tell_units(units, given, origin, words);
    tell_turn(*own, *now, given, origin, words);
    if (words.how.empty()) return {};
    return fmt::format("the bounding boxes match if the first file is {}{}{}", words.how,
                       words.way.empty() ? "" : ": ", words.way);
}

} // namespace facetmill::report
