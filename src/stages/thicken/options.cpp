#include "stages/thicken/options.hpp"

#include "geometry/inspect/inspect.hpp"
#include "options/mark_at.hpp"

#include <fmt/format.h>

namespace facetmill::thicken_stage {

using Mode = ThickenOptions::Mode;

namespace {

/// A choice that also accepts true and false.
void declare_self_intersections(Declare<ThickenOptions>& d) {
    using enum ThickenOptions::SelfIntersections;
    Option& o = d.choice<ThickenOptions::SelfIntersections>(
                     "self_intersections", &ThickenOptions::self_intersections,
                     {{"ignore", ignore, "do not search for intersections (also: false)"},
                      {"count", count, "count the intersecting pairs of faces (also: true)"},
                      {"resolve", resolve,
                       "rebuild a solid that folds or intersects itself, with boolean operations"}},
                     "How to handle walls that intersect.")
                    .also_called(property_named("self_intersections")->also_called)
                    .option();
    o.parse = [plain = o.parse](const Option& self, const Value& v, void* target, Problems& problems) {
        const auto yes = v.is_scalar() && !v.deferred ? v.as_bool() : std::nullopt;
        if (!yes) return plain(self, v, target, problems);
        static_cast<ThickenOptions*>(target)->self_intersections = *yes ? count : ignore;
        return true;
    };
    o.schema = {{"anyOf", Json::array({o.schema, {{"type", "boolean"}}})}};
    o.may_be_true = true;
}

/// Answers a negative thickness, which selects the other side in other programs, with the `side` option.
void declare_thickness(Declare<ThickenOptions>& d) {
    Option& o = d.option("thickness", &ThickenOptions::thickness,
                         "The thickness of the solid, or the diameter of cylinders.")
                    .also_called("distance offset width amount wall")
                    .above(0)
                    .required()
                    .primary()
                    .option();
    o.parse = [plain = o.parse](const Option& self, const Value& v, void* target, Problems& problems) {
        if (!plain(self, v, target, problems)) return false;
        if (v.deferred || !(static_cast<ThickenOptions*>(target)->thickness.amount < 0)) return true;
        problems.add(v.mark, "E-RANGE",
                     fmt::format("'thickness' must be in the range {}, found {}", self.range.to_string(),
                                 v.described()),
                     "remove the minus sign; the thickness is added behind the surface, or in front with "
                     "thicken: {side: outward}");
        return false;
    };
}

void declare_drain(Declare<DrainOptions>& d) {
    d.option("diameter", &DrainOptions::diameter, "The diameter of the holes.").above(0).required().primary();
    d.option("count", &DrainOptions::count, "The maximum number of holes at the lowest points of a cavity.")
        .between(1, 100);
    d.option("vent", &DrainOptions::vent, "Adds a hole at the highest point of each cavity, for air.");
}

} // namespace

void declare_thicken(Declare<ThickenOptions>& d) {
    declare_thickness(d);
    d.choice<ThickenSide>(
        "side", &ThickenOptions::side,
        {{"inward", ThickenSide::inward, "behind the surface, which becomes the front"},
         {"outward", ThickenSide::outward, "in front of the surface, which becomes the back"},
         {"centred", ThickenSide::centred, "half of the thickness on each side"}},
        "The side that gets the thickness.");
    d.choice<Mode>(
        "mode", &ThickenOptions::mode,
        {{"surface", Mode::surface, "make a solid with the given thickness and walls along boundary edges"},
         {"edges", Mode::edges, "turn every edge into a cylinder and remove the faces"},
         {"boundary-edges", Mode::boundary_edges,
          "turn only boundary edges into cylinders and remove the faces"}},
        "The elements that get a thickness.");
    d.option("miter_limit", &ThickenOptions::miter_limit,
             "The largest movement of a vertex at a sharp corner, as a multiple of the thickness.")
        .between(1, 100);
    d.option("sides", &ThickenOptions::sides, "The number of sides of each cylinder.").between(3, 360);
    declare_self_intersections(d);
    d.group("drain", &ThickenOptions::drain,
            "Drills vertical holes through the wall at the lowest points of each cavity, so that resin or "
            "powder can leave it.",
            declare_drain)
        .also_called("drain_holes holes escape_holes", "(drain: 5mm)");
}

void verify_thicken(const ThickenOptions& o, const Value& given, Problems& problems) {
    if (o.drain && o.mode != Mode::surface)
        add_refusal(needs("drain", "mode: surface"), "thicken", given, problems);
}

} // namespace facetmill::thicken_stage
