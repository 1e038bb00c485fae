#include "stage/options/footprint.hpp"

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

std::size_t axis_of(ViewAxis axis, UpAxis up) {
    if (axis == ViewAxis::up) return up == UpAxis::y ? 1 : 2;
    return axis == ViewAxis::x ? 0 : axis == ViewAxis::y ? 1 : 2;
}

void FlatBounds::add(double u, double v) {
    low[0] = std::min(low[0], u);
    low[1] = std::min(low[1], v);
    high[0] = std::max(high[0], u);
    high[1] = std::max(high[1], v);
}

void FlatBounds::add(const FlatBounds& b) {
    add(b.low[0], b.low[1]);
    add(b.high[0], b.high[1]);
}

std::string FlatBounds::text() const {
    return fmt::format("({:.10g}, {:.10g}) to ({:.10g}, {:.10g})", low[0], low[1], high[0], high[1]);
}

bool FlatBounds::may_be_degrees() const {
    return low[0] >= -180 && high[0] <= 180 && low[1] >= -90 && high[1] <= 90;
}

FlatBounds bounds_of(const Footprint& footprint) {
    FlatBounds b;
    for (const auto& ring : footprint.rings())
        for (const auto& p : ring) b.add(p.x, p.y);
    return b;
}

FlatBounds bounds_of(const Part& part, std::size_t axis) {
    FlatBounds b;
    for (const Vec3& local : part.mesh.positions) {
        const Vec3 p = part.transform.point(local);
        b.add(p[axis == 0 ? 1 : 0], p[axis == 2 ? 1 : 2]);
    }
    return b;
}

namespace {

/// Whether the footprint seems to be in degrees and the mesh in metres. Coordinates near 0, 0 may be metres
/// from a local origin. Within a degree of 0, 0 there is only sea, and five degrees are 550 km.
bool is_in_degrees(const FlatBounds& footprint, const FlatBounds& mesh) {
    constexpr double most_degrees = 5, of_sea = 1;
    const FlatBounds& b = footprint;
    const bool at_zero = b.low[0] < of_sea && b.high[0] > -of_sea && b.low[1] < of_sea && b.high[1] > -of_sea;
    return b.may_be_degrees() && b.longest_side() <= most_degrees && !at_zero && !mesh.may_be_degrees();
}

} // namespace

const char* hint_for_missed(const FlatBounds& footprint, const FlatBounds& mesh) {
    return is_in_degrees(footprint, mesh)
               ? "the footprint seems to be in degrees: convert it to the coordinates of "
                 "the mesh with ogr2ogr -t_srs"
               : "check the position and the axis of the footprint, and that it has the "
                 "same origin as the mesh; facetmill info prints the bounds";
}

} // namespace facetmill
