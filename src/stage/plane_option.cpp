#include "stage/plane_option.hpp"

#include "base/numbers.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

using Through = PlaneOption::Through;

/// "30%" or "30pct" -> 30.
std::optional<double> percentage(std::string_view text) {
    for (const std::string_view sign : {"%", "pct"})
        if (text.ends_with(sign)) return parse_real(text.substr(0, text.size() - sign.size()));
    return {};
}

bool parse_short(const Value& value, PlaneOption& out, Problems& problems) {
    const auto wrong = [&](std::string hint) {
        problems.add(value.mark, "E-PLANE", fmt::format("expected a plane, found {}", value.described()),
                     std::move(hint));
        return false;
    };
    const std::string hint =
        "for example z=0.2, z=50%, {normal: [0, 0, 1], through: centre} or {coefficients: [A, B, C, D]}";
    const std::string& text = value.text;
    if (!value.is_scalar() || text.size() < 3 || text[1] != '=' || text[0] < 'x' || text[0] > 'z')
        return wrong(hint);
    out = {};
    out.axis = text[0] - 'x';
    Problems inner;
    if (OptionType<Length>::parse(Value::scalar(text.substr(2), value.mark), out.height, inner)) return true;
    return wrong(hint);
}

/// The plane across n at a percentage of the box's extent along n.
Vec3 point_along(const Vec3& n, double percent, const Box& bounds) {
    if (bounds.empty()) return {};
    Vec3 low = bounds.min, high = bounds.max;
    for (std::size_t i = 0; i < 3; ++i)
        if (n[i] < 0) std::swap(low[i], high[i]);
    return percent == 50 ? bounds.centre() : mix(low, high, percent / 100);
}

} // namespace

bool OptionType<Through>::parse(const Value& value, Through& out, Problems& problems) {
    if (value.deferred) return true;
    out = {};
    if (value.is_scalar() && (value.text == "centre" || value.text == "center")) return true;
    if (value.is_scalar())
        if (const auto percent = percentage(value.text)) return out.percent = *percent, true;
    Problems inner;
    Vec3 point;
    if (OptionType<Vec3>::parse(value, point, inner)) return out.point = point, true;
    problems.add(
        value.mark, "E-TYPE",
        fmt::format("expected centre, a percentage or a point ([0, 0, 1]), found {}", value.described()));
    return false;
}
std::string OptionType<Through>::print(const Through& t) {
    if (t.point) return OptionType<Vec3>::print(*t.point);
    return t.percent == 50 ? "centre" : spelled(t.percent) + "%";
}
Json OptionType<Through>::schema() {
    return {{"anyOf", Json::array({OptionType<Vec3>::schema(),
                                   {{"type", "string"},
                                    {"pattern", "^(centre|center|[0-9.eE+-]+(%|pct)|.*,.*,.*)$"}}})}};
}

void declare_plane(Declare<PlaneOption>& d) {
    d.option("normal", &PlaneOption::normal, "The direction across the plane; its length does not matter.");
    d.option("through", &PlaneOption::through,
             "A point of the plane in world space: centre (of the bounds), [x, y, z] in scene units, or a "
             "percentage of the "
             "extent along the normal.");
    d.option("coefficients", &PlaneOption::coefficients,
             "A, B, C and D of A x + B y + C z + D = 0, in scene units.");
    d.exactly_one({"normal", "coefficients"});
    d.at_most_one({"through", "coefficients"});
    d.shorthand(
        "x=, y= or z= and a length or a percentage of the extent along that axis: z=0.2, z=2mm, z=50%.",
        {{"type", "string"}, {"pattern", "^[xyz]=.+$"}}, parse_short);
}

Plane resolve(const PlaneOption& o, const Scene& scene, const Box& bounds, Context& context) {
    Plane plane;
    if (o.axis >= 0) {
        const auto axis = static_cast<std::size_t>(o.axis);
        plane.normal = {};
        plane.normal[axis] = 1;
        if (o.height.kind == Length::Kind::percent)
            plane.through[axis] = point_along(plane.normal, o.height.amount, bounds)[axis];
        else
            plane.through[axis] = context.resolve(o.height, scene, "plane");
    } else if (!o.coefficients.empty()) {
        if (o.coefficients.size() != 4)
            throw Error(
                ErrorKind::usage, "E-PLANE",
                fmt::format("coefficients are four numbers, A, B, C and D, found {}", o.coefficients.size()));
        plane = {{o.coefficients[0], o.coefficients[1], o.coefficients[2]}, {}, o.coefficients[3]};
    } else {
        plane.normal = o.normal.value_or(Vec3{0, 0, 1});
        plane.through =
            o.through.point ? *o.through.point : point_along(plane.normal, o.through.percent, bounds);
    }
    check_plane(plane);
    return plane;
}

} // namespace facetmill
