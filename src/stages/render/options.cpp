#include "stages/render/options.hpp"

#include "base/math/portable_math.hpp"
#include "base/text/spelling.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/quantities/quantities.hpp"
#include "options/lists.hpp"
#include "options/mark_at.hpp"
#include "stage/options/synonyms.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace facetmill {

namespace {

using Look = RenderOptions::Look;
using Ground = RenderOptions::Ground;

const std::vector<NamedChoice<Viewpoint>>& viewpoints() {
    static const std::vector<NamedChoice<Viewpoint>> all{
        {"corner", Viewpoint::corner, "from the front, slightly from above and from the right"},
        {"front", Viewpoint::front, "along -z if y points up, along +y if z points up"},
        {"back", Viewpoint::back, "from behind"},
        {"left", Viewpoint::left, "from the left of the front"},
        {"right", Viewpoint::right, "from the right of the front"},
        {"top", Viewpoint::top, "from above, with the front at the bottom"},
        {"bottom", Viewpoint::bottom, "from below, with the front at the top"}};
    return all;
}

constexpr const char* turntable = "turntable";
constexpr std::size_t turns = 8;

const NamedChoice<Viewpoint>* viewpoint_named(const std::string& name) {
    for (const auto& v : viewpoints())
        if (v.name == name) return &v;
    return nullptr;
}

/// The number of pictures, and the number of pictures per row.
std::pair<std::size_t, std::size_t> count_and_columns(const RenderOptions& o) {
    std::size_t count = 0;
    for (const auto& view : o.views) count += view == turntable ? turns : 1;
    count = std::max<std::size_t>(count, 1);
    if (o.with) return {(o.shading == Look::beside ? 4 : 2) * count, 2};
    if (o.shading == Look::beside) return {2 * count, 2};
    return {count, std::min<std::size_t>(count, 4)};
}

double largest_component(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// The colour of the ground in linear light.
std::optional<std::array<float, 3>> ground_of(Ground ground) {
    const auto grey = [](float linear) { return std::array<float, 3>{linear, linear, linear}; };
    switch (ground) {
    case Ground::white:
        return grey(1);
    case Ground::light:
        return grey(0.9f);
    case Ground::grey:
        return grey(0.7f);
    case Ground::dark:
        return grey(0.013f);
    case Ground::black:
        return grey(0);
    case Ground::none:
        break;
    }
    return {};
}

} // namespace

bool OptionType<ColourRange>::parse(const Value& value, ColourRange& out, Problems& problems) {
    using Kind = ColourRange::Kind;
    if (value.deferred) return true;
    const std::string expected = "auto, percentile, all, or two numbers ([0, 2.5])";
    std::vector<std::optional<double>> numbers;
    if (value.is_scalar())
        for (const auto& [name, kind] :
             {std::pair{"auto", Kind::automatic}, {"percentile", Kind::percentile}, {"all", Kind::all}})
            if (value.text == name) {
                out.kind = kind;
                return true;
            }
    const Value list = listed(value); // "0,2.5" in the one-liner's syntax
    for (const auto& item : list.items) numbers.push_back(item.as_real());
    if (numbers.size() != 2 || !numbers[0] || !numbers[1] || !(*numbers[0] < *numbers[1]))
        return wrong_type(value, expected, problems, "the first number is less than the second");
    out = {Kind::given, *numbers[0], *numbers[1]};
    return true;
}

std::string OptionType<ColourRange>::print(const ColourRange& range) {
    switch (range.kind) {
    case ColourRange::Kind::automatic:
        return "auto";
    case ColourRange::Kind::percentile:
        return "percentile";
    case ColourRange::Kind::all:
        return "all";
    case ColourRange::Kind::given:
        break;
    }
    return fmt::format("[{}, {}]", range.min, range.max);
}

Json OptionType<ColourRange>::schema() {
    const Json numbers = {
        {"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 2}, {"maxItems", 2}};
    return {{"anyOf", Json::array({{{"enum", Json::array({"auto", "percentile", "all"})}}, numbers})}};
}

void declare_render(Declare<RenderOptions>& d) {
    d.option("path", &RenderOptions::path, "The PNG file to write. - writes to standard output.")
        .also_called(path_synonyms)
        .required()
        .primary();
    d.option("with", &RenderOptions::with,
             "Another mesh file to draw to the right of the scene, with the same camera, scale and colour "
             "scale. width and height apply to each of the two.")
        .also_called(with_synonyms);
    d.choice<Viewpoint>("view", &RenderOptions::view, viewpoints(), "The viewpoint.")
        .also_called("camera direction");
    d.option("views", &RenderOptions::views,
             "Several views in one image, four in a row, at the same scale. turntable means eight views "
             "around the scene. width and height apply to each view.");
    d.option("from", &RenderOptions::from,
             "The direction towards the viewer in world space, instead of view.");
    d.option("perspective", &RenderOptions::perspective,
             "The angle of view over the whole scene. Default: parallel projection.")
        .between(1, 120);
    d.option("at", &RenderOptions::at, "The world position at the centre of the image, which is magnified.");
    d.option("zoom", &RenderOptions::zoom, "The magnification. Default: 1, or 4 with at.").between(1, 10000);
    d.option("width", &RenderOptions::width, "The size in pixels.").between(1, 8192);
    d.option("height", &RenderOptions::height, "The size in pixels.").between(1, 8192);
    d.choice<Look>(
        "shading", &RenderOptions::shading,
        {{"sides", Look::sides,
          "light both sides; inner sides are orange, except for double-sided materials"},
         {"one-sided", Look::one_sided, "use the cosine: reversed faces are dark"},
         {"absolute", Look::absolute, "use the absolute value: the back is shaded like the front"},
         {"beside", Look::beside, "show two images: one-sided on the left, absolute on the right"}},
        "How the angle between a face normal and the light affects brightness.");
    d.choice<ShadingNormals>(
        "normals", &RenderOptions::normals,
        {{"auto", ShadingNormals::automatic, "the normals of the mesh if it has any, otherwise flat"},
         {"flat", ShadingNormals::flat, "one normal for each face"},
         {"smooth", ShadingNormals::smooth,
          "the normals of the mesh, otherwise computed ones, with edges where faces meet at more than 40 "
          "degrees"}},
        "The normals for shading.");
    d.option("occlusion", &RenderOptions::occlusion,
             "Darkens folds and corners, which receive less ambient light.");
    d.option("silhouettes", &RenderOptions::silhouettes, "Draws outlines.");
    d.choice<Paint>("colours", &RenderOptions::colours,
                    {{"material", Paint::material,
                      "the base colour multiplied by its texture and by vertex and face colours, with the "
                      "material's normal, emissive and occlusion textures and alpha"},
                     {"part", Paint::part, "one colour for each part"},
                     {"normal", Paint::normal, "the face normal, with x, y, z as red, green, blue"},
                     {"plain", Paint::plain, "grey"}},
                    "How to colour faces.")
        .also_called("colors color_by");
    d.option("attribute", &RenderOptions::attribute,
             fmt::format("Colours faces by this attribute. Identifiers (group, failed, cut_id) get distinct "
                         "colours. Other numbers use a scale from dark blue over green to yellow (viridis). "
                         "If no part has the attribute, these are measured: {}.",
                         fmt::join(quantity_names(), ", ")))
        .also_called(attribute_synonyms);
    d.option("range", &RenderOptions::range,
             "The values at the ends of the colour scale. all uses the smallest and the largest value, "
             "percentile the 1st and 99th percentile. auto uses percentile if a few outliers take up more "
             "than half of the range, otherwise all. Or give two numbers.");
    d.option("legend", &RenderOptions::legend,
             "Draws the colour scale with numbers next to the scene. It is omitted if it would take more "
             "than half of the width, or does not fit into the height.");
    d.option("unit", &RenderOptions::unit,
             "The unit of the attribute, for the legend. For measured attributes it follows from the scene's "
             "unit.")
        .also_called(property_named("unit")->also_called);
    d.choice<EdgeLines>("edges", &RenderOptions::edges,
                        {{"few", EdgeLines::few, "if the scene has at most 6000 faces"},
                         {"all", EdgeLines::all, "always"},
                         {"no", EdgeLines::no, "never"}},
                        "Draws the edges of faces.");
    d.choice<Ground>("background", &RenderOptions::ground,
                     {{"none", Ground::none, "transparent"},
                      {"white", Ground::white, "white"},
                      {"light", Ground::light, "very light grey"},
                      {"grey", Ground::grey, "light grey"},
                      {"dark", Ground::dark, "nearly black"},
                      {"black", Ground::black, "black"}},
                     "The background of the image.")
        .also_called("bg");
    d.option("point", &RenderOptions::point, "The side of the squares for points of point clouds, in pixels.")
        .between(0.5, 100)
        .measures(Dimension::none);
    d.at_most_one({"view", "views", "from"});
    d.at_most_one({"colours", "attribute"});
    d.at_most_one({"with", "perspective"});
    d.at_most_one({"with", "views"});
}

void verify_render(const RenderOptions& o, const Value& given, Problems& problems) {
    if (o.path.text != "-" && !o.path.text.ends_with(".png"))
        problems.add(mark_at(given, "path"), "E-PICTURE",
                     fmt::format("render: images are PNG, and '{}' does not end in .png", o.path.text),
                     "for example render: view.png");
    if (o.from && !(largest_component(*o.from) > 0))
        problems.add(mark_at(given, "from"), "E-DIRECTION", "render: 'from' needs a direction, found 0 0 0",
                     "give a direction: from: [1, -2, 1]");
    for (const auto& view : o.views)
        if (view != turntable && !viewpoint_named(view)) {
            std::vector<std::string> names{turntable};
            for (const auto& v : viewpoints()) names.push_back(v.name);
            const std::string near = nearest(view, names);
            problems.add(mark_at(given, "views"), "E-CHOICE",
                         fmt::format("render: view '{}' does not exist", view),
                         near.empty() ? fmt::format("use one of {}", fmt::join(names, ", "))
                                      : fmt::format("did you mean '{}'?", near));
        }
    const auto [count, columns] = count_and_columns(o);
    const double rows = std::ceil(static_cast<double>(count) / static_cast<double>(columns));
    constexpr double most = 8192.0 * 8192;
    if (static_cast<double>(columns) * static_cast<double>(o.width) * rows * static_cast<double>(o.height) >
        most)
        problems.add(mark_at(given, "views"), "E-RANGE",
                     fmt::format("render: {} views of {} x {} pixels are more than 8192 x 8192", count,
                                 o.width, o.height),
                     "reduce width and height, which apply to each view");
}

PictureSettings common_settings(const RenderOptions& o, const Scene& scene, const Context& context) {
    PictureSettings s;
    s.width = static_cast<int>(o.width);
    s.height = static_cast<int>(o.height);
    s.viewpoint = o.view;
    if (o.from) s.from = *o.from / largest_component(*o.from); // squares of tiny numbers are 0
    if (o.perspective) s.perspective = o.perspective->radians;
    s.at = o.at;
    s.zoom = o.zoom.value_or(o.at ? 4 : 1);
    s.shading = o.shading == Look::sides      ? Shading::sides
                : o.shading == Look::absolute ? Shading::absolute
                                              : Shading::one_sided;
    s.normals = o.normals;
    s.occlusion = o.occlusion;
    s.silhouettes = o.silhouettes;
    s.paint = o.colours;
    s.attribute = o.attribute;
    s.range = o.range;
    s.legend = o.legend;
    s.unit = o.unit;
    s.edges = o.edges;
    s.point = o.point;
    s.ground = ground_of(o.ground);
    s.shows = [&](const Part& part) { return context.selects(part, scene); };
    return s;
}

Shots shots_of(const RenderOptions& o, const Scene& scene, const PictureSettings& given) {
    Shots shots;
    shots.columns = count_and_columns(o).second;
    PictureSettings common = given;
    const auto add = [&](const PictureSettings& s) {
        shots.settings.push_back(s);
        if (o.shading != Look::beside) return;
        shots.settings.push_back(s);
        shots.settings.back().shading = Shading::absolute;
    };
    if (o.views.empty()) add(common);
    for (const auto& view : o.views) {
        PictureSettings s = common;
        if (const auto* named = viewpoint_named(view)) s.viewpoint = named->value;
        for (std::size_t i = 0; i < (view == turntable ? turns : 1); ++i) {
            s.turn = 2 * pi * static_cast<double>(i) / turns;
            add(s);
        }
    }
    if (shots.settings.size() > 1) {
        for (const auto& s : shots.settings)
            common.max_scale = std::min(common.max_scale, fitting_scale(scene, s));
        for (auto& s : shots.settings) s.max_scale = common.max_scale;
    }
    return shots;
}

} // namespace facetmill
