#include "diff/conversion.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

/// How a scene is turned to bring one up axis to another.
enum class UpTurn { none, y_to_z, z_to_y };

Vec3 turned(const Vec3& p, UpTurn turn) {
    switch (turn) {
    case UpTurn::y_to_z:
        return {p.x, -p.z, p.y};
    case UpTurn::z_to_y:
        return {p.x, p.z, -p.y};
    case UpTurn::none:
        break;
    }
    return p;
}

Box turned(const Box& box, UpTurn turn) {
    Box out;
    out.add(turned(box.min, turn));
    out.add(turned(box.max, turn));
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

std::string words_for(const UnitFactor& units, UpTurn turn) {
    std::string how, way;
    if (units.factor != 1) {
        how = fmt::format(" times {:.6g}, as from {} to {}", units.factor, to_string(units.from),
                          to_string(units.to));
        way = "--unit says what unit a file has that states none";
    }
    if (turn != UpTurn::none) {
        const bool to_z = turn == UpTurn::y_to_z;
        how += fmt::format("{} turned from {} up to {} up", how.empty() ? "" : ", and", to_z ? "y" : "z",
                           to_z ? "z" : "y");
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
    for (const UpTurn turn : {UpTurn::none, UpTurn::y_to_z, UpTurn::z_to_y})
        if (is_box(turned(first, turn), second, units.factor))
            return units.factor == 1 && turn == UpTurn::none ? std::string() : words_for(units, turn);
    return {};
}

} // namespace facetmill::report
