#include "stages/crop/footprint.hpp"

#include "base/hash.hpp"
#include "options/lists.hpp"
#include "stage/read_recorded.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

bool refuse(const Value& value, Problems& problems) {
    problems.add(
        value.mark, "E-TYPE",
        fmt::format("expected a footprint (a file, POLYGON ((0 0, 1 0, 1 1)), [[0, 0], [1, 0], [1, 1]], "
                    "or a list of such rings), found {}",
                    value.described()));
    return false;
}

bool parse_text(const Value& value, FootprintOption& out, Problems& problems) {
    try {
        out.rings = io::parse_wkt(value.text, "the footprint");
    } catch (const Error& error) {
        problems.add(value.mark, "E-WKT", error.diagnostics().front().message);
        return false;
    }
    return true;
}

bool parse_ring(const Value& value, FootprintOption& out, Problems& problems) {
    if (!value.is_list()) return refuse(value, problems);
    auto& ring = out.rings.emplace_back();
    for (const Value& p : value.items) {
        if (!p.is_list() || p.items.size() != 2) return refuse(p, problems);
        Vec2 at;
        if (!OptionType<double>::parse(p.items[0], at.x, problems) ||
            !OptionType<double>::parse(p.items[1], at.y, problems))
            return false;
        ring.push_back(at);
    }
    return true;
}

} // namespace

bool OptionType<FootprintOption>::parse(const Value& value, FootprintOption& out, Problems& problems) {
    if (value.deferred) return true;
    if (value.is_scalar() && io::is_wkt(value.text)) return parse_text(value, out, problems);
    if (value.is_scalar() && value.text.starts_with('[')) {
        const auto list = list_in_text(value);
        return list ? parse(*list, out, problems) : refuse(value, problems);
    }
    if (value.is_scalar() && !value.text.empty()) {
        out.path = value.text;
        return true;
    }
    if (!value.is_list() || value.items.empty()) return refuse(value, problems);
    const bool nested =
        value.items[0].is_list() && !value.items[0].items.empty() && value.items[0].items[0].is_list();
    if (!nested) return parse_ring(value, out, problems);
    bool good = true;
    for (const Value& ring : value.items) good &= parse_ring(ring, out, problems);
    return good;
}

Json OptionType<FootprintOption>::schema() {
    const Json point = {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 2}, {"maxItems", 2}};
    const Json ring = {{"type", "array"}, {"items", point}, {"minItems", 3}};
    return {{"anyOf", Json::array({{{"type", "string"}}, ring, {{"type", "array"}, {"items", ring}}})}};
}

void verify_footprint(const FootprintOption& option, const Value& value, std::string_view stage,
                      Problems& problems) {
    if (value.deferred || !option.path.empty()) return;
    try {
        static_cast<void>(Footprint(option.rings));
    } catch (const Error& error) {
        const Diagnostic& d = error.diagnostics().front();
        problems.add(value.mark, d.id, fmt::format("{}: {}", stage, d.message), d.hint);
    }
}

namespace {

/// The factor from the unit of a file to the unit of the scene. Warns (W-UNITS) if only one of them is known.
double unit_factor(const io::FootprintFile& file, const std::string& name, Unit scene, Context& context) {
    if (file.metres > 0 && scene != Unit::unknown) return file.metres / metres(scene);
    if (file.metres > 0)
        context.warn(
            "W-UNITS",
            fmt::format(
                "{}: '{}' states its unit, but the scene has none: its numbers are read as scene units",
                context.name(), name),
            "give the unit of the mesh: load: {unit: mm}");
    else if (file.can_state_unit && scene != Unit::unknown)
        context.warn("W-UNITS",
                     fmt::format("{}: '{}' states no unit: its numbers are read as {}", context.name(), name,
                                 to_string(scene)),
                     "set the unit of the drawing ($INSUNITS) in the CAD program");
    return 1;
}

} // namespace

Footprint resolve_footprint(const FootprintOption& option, Unit unit, Context& context) {
    if (option.path.empty()) return Footprint(option.rings);
    const io::Input input = io::Input::open(context.places().input(option.path));
    record_input(context, input.name(), input.stored().size(), sha256(input.stored()));
    io::FootprintFile file = io::read_footprint(input);
    for (const Diagnostic& w : file.warnings)
        context.warn(w.id, fmt::format("{}: '{}': {}", context.name(), option.path, w.message), w.hint);
    const double factor = unit_factor(file, option.path, unit, context);
    if (factor != 1)
        for (auto& ring : file.rings)
            for (Vec2& p : ring) p = p * factor;
    return Footprint(std::move(file.rings));
}

} // namespace facetmill
