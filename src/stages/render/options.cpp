#include "stages/render/options.hpp"

#include "options/mark_at.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

using Look = RenderOptions::Look;
using Ground = RenderOptions::Ground;

} // namespace

void declare_render(Declare<RenderOptions>& d) {
    d.option("path", &RenderOptions::path, "The PNG file to write; - is standard output.")
        .required()
        .primary();
    d.choice<Viewpoint>(
        "view", &RenderOptions::view,
        {{"corner", Viewpoint::corner, "from the front, slightly from above and from the right"},
         {"front", Viewpoint::front, "along -z where y points up, along +y where z does"},
         {"back", Viewpoint::back, "from behind"},
         {"left", Viewpoint::left, "from the left of the front"},
         {"right", Viewpoint::right, "from the right of the front"},
         {"top", Viewpoint::top, "from above, the front at the bottom"},
         {"bottom", Viewpoint::bottom, "from below, the front at the top"}},
        "The direction of view; the projection is parallel.");
    d.option("from", &RenderOptions::from,
             "The direction towards the viewer in world space, instead of view.");
    d.option("width", &RenderOptions::width, "Pixels (a count).").between(1, 8192);
    d.option("height", &RenderOptions::height, "Pixels (a count).").between(1, 8192);
    d.choice<Look>("shading", &RenderOptions::shading,
                   {{"sides", Look::sides,
                     "both sides are lit; inner sides are orange, except with double-sided materials"},
                    {"one-sided", Look::one_sided, "the usual shading: reversed faces are dark"},
                    {"absolute", Look::absolute, "by absolute value: the back is shaded like the front"},
                    {"beside", Look::beside, "two images: one-sided, and absolute to the right of it"}},
                   "How the angle between a face's normal and the light is used.");
    d.choice<Paint>("colours", &RenderOptions::colours,
                    {{"material", Paint::material,
                      "the base colour multiplied by the colours of vertices and faces; no textures"},
                     {"part", Paint::part, "one colour for each part"},
                     {"normal", Paint::normal, "the normal of the face, with x, y, z as red, green, blue"},
                     {"plain", Paint::plain, "grey"}},
                    "How faces are coloured.");
    d.option("attribute", &RenderOptions::attribute,
             "Colours by this attribute where a part has it: identifiers (group, failed, cut_id) get "
             "distinct colours, other numbers a scale from blue to yellow.");
    d.choice<EdgeLines>("edges", &RenderOptions::edges,
                        {{"few", EdgeLines::few, "if the scene has at most 6000 faces"},
                         {"all", EdgeLines::all, "always"},
                         {"no", EdgeLines::no, "never"}},
                        "Whether the edges of faces are drawn.");
    d.choice<Ground>("background", &RenderOptions::ground,
                     {{"none", Ground::none, "transparent"},
                      {"white", Ground::white, "white"},
                      {"grey", Ground::grey, "light grey"},
                      {"black", Ground::black, "black"}},
                     "The background of the image.");
    d.option("point", &RenderOptions::point,
             "The side of the squares drawn for the vertices of parts without faces, in pixels.")
        .between(0.5, 100)
        .measures(Dimension::none);
    d.at_most_one({"view", "from"});
    d.at_most_one({"colours", "attribute"});
}

void verify_render(const RenderOptions& o, const Value& given, Problems& problems) {
    if (o.path.text != "-" && !o.path.text.ends_with(".png"))
        problems.add(mark_at(given, "path"), "E-PICTURE",
                     fmt::format("render: images are PNG, and '{}' does not end in .png", o.path.text),
                     "for example render: view.png");
    if (o.from && !(length(*o.from) > 0))
        problems.add(mark_at(given, "from"), "E-DIRECTION", "render: 'from' needs a direction, found 0 0 0",
                     "for example from: [1, -2, 1]");
}

PictureSettings picture_settings(const RenderOptions& o, const Scene& scene, const Context& context) {
    PictureSettings s;
    s.width = static_cast<int>(o.width);
    s.height = static_cast<int>(o.height);
    s.viewpoint = o.view;
    s.from = o.from;
    s.paint = o.colours;
    s.attribute = o.attribute;
    s.edges = o.edges;
    s.point = o.point;
    const float grey = o.ground == Ground::white ? 1.0f : o.ground == Ground::grey ? 0.7f : 0.0f;
    if (o.ground != Ground::none) s.ground = {grey, grey, grey};
    s.shows = [&](const Part& part) { return context.selects(part, scene); };
    return s;
}

} // namespace facetmill
