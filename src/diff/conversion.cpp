#include "diff/conversion.hpp"

#include "io/convert.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

/// From one up axis to another; the same: not at all.
struct UpTurn {
    UpAxis from = UpAxis::y, to = UpAxis::y;
    bool any() const { return from != to; }
};

Box turned(const Box& box, const UpTurn& turn) {
    const Transform t = io::turn_up(turn.from, turn.to);
    Box out;
    out.add(t.point(box.min));
    out.add(t.point(box.max));
    return out;
}

/// Within a hundredth of the diagonal, corner by corner.
bool is_box(const Box& a, const Box& b, double factor) {
    const double most = a.diagonal() / 100;
    return length(a.min * factor - b.min) <= most * factor && length(a.max * factor - b.max) <= most * factor;
}

struct UnitFactor {
    double factor = 1; ///< what numbers in `to` are multiples of those in `from`
    Unit from = Unit::unknown, to = Unit::unknown;
};

/// The pair of units whose factor is nearest to the ratio, within two hundredths; units people model in come
/// first.
UnitFactor unit_factor(double ratio) {
    constexpr std::array units{Unit::mm, Unit::m, Unit::cm, Unit::inch, Unit::foot, Unit::um, Unit::km};
    UnitFactor best;
    double nearest = std::abs(std::log(ratio));
    for (const Unit from : units)
        for (const Unit to : units) {
            const double factor = metres(from) / metres(to);
            const double off = std::abs(std::log(ratio / factor));
            if (off < nearest - 1e-9) {
                best = {factor, from, to};
                nearest = off;
            }
        }
    return nearest < 0.02 ? best : UnitFactor{};
}

std::string words_for(const UnitFactor& units, const UpTurn& turn) {
    std::string how, way;
    if (units.factor != 1) {
        how = fmt::format(" times {:.6g}, as from {} to {}", units.factor, to_string(units.from),
                          to_string(units.to));
        way = "--unit says what unit a file has that states none";
    }
    if (turn.any()) {
        how += fmt::format("{} turned from {} up to {} up", how.empty() ? "" : ", and", to_string(turn.from),
                           to_string(turn.to));
        way += fmt::format("{}--up which axis is up in it", way.empty() ? "" : ", ");
        if (units.factor == 1) way = "--up says which axis is up in a file that states none";
    }
    return fmt::format("the box of the second file is that of the first{}: {}", how, way);
}

} // namespace

std::string conversion_hint(const Scene& a, const Scene& b) {
    const Box first = a.bounds(), second = b.bounds();
    const double size_a = first.diagonal(), size_b = second.diagonal();
    if (!(size_a > 0) || !(size_b > 0) || !std::isfinite(size_a) || !std::isfinite(size_b)) return {};
    const UnitFactor units = unit_factor(size_b / size_a);
    for (const UpTurn& turn : {UpTurn{}, UpTurn{UpAxis::y, UpAxis::z}, UpTurn{UpAxis::z, UpAxis::y}})
        if (is_box(turned(first, turn), second, units.factor))
            return units.factor == 1 && !turn.any() ? std::string() : words_for(units, turn);
    return {};
}

} // namespace facetmill::report
