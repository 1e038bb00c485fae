#include "stage/options/plane.hpp"

#include "stage/options/numbers.hpp"

#include "base/math/numbers.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

bool refuse(const Value& value, std::string_view expected, Problems& problems) {
    problems.add(value.mark, "E-TYPE", fmt::format("expected {}, found {}", expected, value.described()));
    return false;
}

/// Reads "25%" or "25pct" as a percentage.
std::optional<double> percentage(std::string_view text) {
    for (const std::string_view sign : {"%", "pct"})
        if (text.ends_with(sign)) return parse_real(text.substr(0, text.size() - sign.size()));
    return {};
}

bool is_centre(std::string_view text) { return text == "centre" || text == "center"; }

constexpr std::string_view short_forms =
    "a plane ({normal: [0, 0, 1], through: centre}, z=0.2, x=10%, [A, B, C, D])";

/// Reads "z=0.2": an axis and a position on it. Ignores blanks.
bool parse_short(const Value& value, PlaneOption& out, Problems& problems) {
    if (value.is_list() || value.text.find(',') != std::string::npos)
        return OptionType<PlaneCoefficients>::parse(value, out.coefficients.emplace(), problems);
    std::string given = value.text;
    std::erase(given, ' ');
    const auto equals = given.find('=');
    const auto axis = std::string_view("xyz").find(given.empty() ? '?' : given[0]);
    if (equals != 1 || axis == std::string_view::npos) return refuse(value, short_forms, problems);
    out.normal.emplace();
    (*out.normal)[axis] = 1;
    const std::string text = given.substr(2);
    if (is_centre(text)) {
        out.through.kind = PlanePlace::Kind::centre;
        return true;
    }
    if (const auto percent = percentage(text)) {
        out.through.kind = PlanePlace::Kind::extent;
        out.through.percent = *percent;
        return true;
    }
    Problems unheard; // the part after the equals sign has no position of its own
    out.through.kind = PlanePlace::Kind::level;
    if (OptionType<Length>::parse(Value::scalar(text, value.mark), out.through.level, unheard)) return true;
    return refuse(value, short_forms, problems);
}

const Declaration& plane_declaration() {
    static const Declaration declaration = [] {
        Declare<PlaneOption> d;
        declare_plane(d);
        return d.declaration;
    }();
    return declaration;
}

/// Flags the vertices that faces use; all vertices of a mesh without faces.
std::vector<std::uint8_t> placed_vertices(const Mesh& mesh) {
    std::vector<std::uint8_t> used(mesh.vertex_count(), mesh.face_count() == 0);
    for (Index c = 0; c < mesh.corner_count(); ++c) used[mesh.vertex(c)] = 1;
    return used;
}

/// The extent along n, and the box, of the geometry that the plane refers to: faces, or points if there are
/// no faces.
struct Reach {
    double low = HUGE_VAL, high = -HUGE_VAL;
    Box box;

    void add(const Mesh& mesh, const Transform& map, const Vec3& n) {
        const std::vector<std::uint8_t> used = placed_vertices(mesh);
        const Reach all = parallel_reduce(
            mesh.vertex_count(), Reach{},
            [&](std::size_t begin, std::size_t end) {
                Reach r;
                for (std::size_t v = begin; v < end; ++v) {
                    if (!used[v]) continue;
                    const Vec3 p = map.identity() ? mesh.positions[v] : map.point(mesh.positions[v]);
                    r.box.add(p);
                    r.low = std::min(r.low, dot(n, p));
                    r.high = std::max(r.high, dot(n, p));
                }
                return r;
            },
            [](Reach a, const Reach& b) {
                a.join(b);
                return a;
            });
        join(all);
    }
    void join(const Reach& b) {
        low = std::min(low, b.low);
        high = std::max(high, b.high);
        box.add(b.box);
    }
};

Reach reach_of(const Scene& scene, const Part* local, const Vec3& normal) {
    Reach reach;
    if (local)
        reach.add(local->mesh, {}, normal);
    else
        for (const Part& part : scene.parts) reach.add(part.mesh, part.transform, normal);
    if (reach.box.empty()) {
        reach.box.add(Vec3{});
        reach.low = reach.high = 0;
    }
    return reach;
}

} // namespace

bool OptionType<PlanePlace>::parse(const Value& value, PlanePlace& out, Problems& problems) {
    if (value.deferred) return true;
    if (value.is_scalar() && is_centre(value.text)) {
        out.kind = PlanePlace::Kind::centre;
        return true;
    }
    if (value.is_scalar())
        if (const auto percent = percentage(value.text)) {
            out.kind = PlanePlace::Kind::extent;
            out.percent = *percent;
            return true;
        }
    out.kind = PlanePlace::Kind::point;
    Problems unheard;
    if (OptionType<Vec3>::parse(value, out.point, unheard)) return true;
    return refuse(value, "a point ([0, 0, 1]), centre, or a percentage of the extent along the normal (25%)",
                  problems);
}
std::string OptionType<PlanePlace>::print(const PlanePlace& value) {
    if (value.kind == PlanePlace::Kind::centre) return "centre";
    if (value.kind == PlanePlace::Kind::extent) return to_string(value.percent) + "%";
    return OptionType<Vec3>::print(value.point);
}
Json OptionType<PlanePlace>::schema() {
    return {
        {"anyOf", Json::array({OptionType<Vec3>::schema(),
                               {{"type", "string"}, {"pattern", "^(cent(re|er)|[0-9.eE+-]+ *(%|pct))$"}}})}};
}

bool OptionType<PlaneCoefficients>::parse(const Value& value, PlaneCoefficients& out, Problems& problems) {
    return parse_numbers(value, out.abcd, "four numbers ([A, B, C, D])", problems);
}
std::string OptionType<PlaneCoefficients>::print(const PlaneCoefficients& value) {
    const auto& v = value.abcd;
    return fmt::format("[{}, {}, {}, {}]", to_string(v[0]), to_string(v[1]), to_string(v[2]),
                       to_string(v[3]));
}
Json OptionType<PlaneCoefficients>::schema() { return numbers_schema(4); }

void declare_plane(Declare<PlaneOption>& d) {
    d.option("normal", &PlaneOption::normal,
             "The normal of the plane. Its length can be any number except zero.");
    d.option("through", &PlaneOption::through,
             "A point of the plane in scene units, centre (of the bounding box), or a percentage of the "
             "extent along the normal. At 0%, everything is in front.");
    d.option("coefficients", &PlaneOption::coefficients,
             "A, B, C, D of A x + B y + C z + D = 0, in scene units; the normal is (A, B, C).");
    d.at_most_one({"normal", "coefficients"});
    d.at_most_one({"through", "coefficients"});
    const Json text = {{"type", "string"}, {"pattern", "^ *[xyz] *="}};
    d.shorthand(ShortForm::text_or_list,
                "z=0.2, x=10%, y=2mm or z=centre means the plane perpendicular to that axis at that "
                "position. [A, B, C, D] gives the coefficients.",
                {{"anyOf", Json::array({text, OptionType<PlaneCoefficients>::schema()})}},
                [](const Value& value, PlaneOption& out, Problems& problems) {
                    return parse_short(value, out, problems);
                });
}

bool OptionType<PlaneOption>::parse(const Value& value, PlaneOption& out, Problems& problems) {
    return plane_declaration().parse(value, &out, "planes", problems);
}
Json OptionType<PlaneOption>::schema() { return plane_declaration().schema(); }

std::optional<Value> length_in_plane(const Value& value) {
    PlaneOption plane;
    Problems ignored; // the text is not a plane with a length
    if (!value.is_scalar() || value.deferred || !OptionType<PlaneOption>::parse(value, plane, ignored) ||
        plane.through.kind != PlanePlace::Kind::level)
        return {};
    Value length = Value::scalar(value.text.substr(2), value.mark);
    const int before = value.quoted ? 3 : 2; // the axis and the equals sign
    length.mark.column += before;
    length.mark.length = static_cast<int>(length.text.size());
    return length;
}

void verify_plane(const PlaneOption& plane, const Mark& where, Problems& problems) {
    if (!plane.normal && !plane.coefficients) {
        problems.add(where, "E-PLANE", "a plane needs a normal or coefficients",
                     "give a direction: plane: {normal: [0, 0, 1]}");
        return;
    }
    const auto zero = [](double x) { return x == 0; };
    if (plane.normal
            ? *plane.normal == Vec3{}
            : std::all_of(plane.coefficients->abcd.begin(), plane.coefficients->abcd.begin() + 3, zero))
        problems.add(where, "E-PLANE", "the plane's normal is zero, so it has no direction",
                     "give a direction: plane: {normal: [0, 0, 1]}");
}

Plane resolve_plane(const PlaneOption& option, const Scene& scene, Context& context, std::string_view name,
                    const Part* local) {
    Plane plane;
    if (option.coefficients) {
        const auto& v = option.coefficients->abcd;
        plane = {{v[0], v[1], v[2]}, {}, v[3]};
        check_plane(plane);
        return plane;
    }
    plane.normal = option.normal.value_or(Vec3{});
    check_plane(plane);
    if (option.through.kind == PlanePlace::Kind::point) {
        plane.through = option.through.point;
    } else if (option.through.kind == PlanePlace::Kind::level) {
        const double level = context.resolve(option.through.level, scene, name, local);
        plane.through = plane.normal * level; // the short form's normal is a unit axis
    } else {
        const Reach reach = reach_of(scene, local, plane.normal);
        plane.through = reach.box.centre();
        if (option.through.kind == PlanePlace::Kind::extent) {
            const double level = reach.low + (reach.high - reach.low) * (option.through.percent / 100);
            plane.through = plane.normal * (level / dot(plane.normal, plane.normal));
        }
    }
    check_plane(plane);
    return plane;
}

} // namespace facetmill
