#include "geometry/picture.hpp"
#include "io/png.hpp"
#include "options/mark_at.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

enum class Look { sides, one_sided, absolute, beside };
enum class Ground { none, white, grey, black };

struct RenderOptions {
    PathText path;
    std::int64_t width = 1200, height = 900;
    Viewpoint view = Viewpoint::corner;
    std::optional<Vec3> from;
    Look shading = Look::sides;
    Paint colours = Paint::material;
    std::string attribute;
    EdgeLines edges = EdgeLines::few;
    Ground ground = Ground::none;
    double point = 3;
};

void declare(Declare<RenderOptions>& d) {
    d.option("path", &RenderOptions::path, "The PNG file to write; - is standard output.")
        .required()
        .primary();
    d.choice<Viewpoint>("view", &RenderOptions::view,
                        {{"corner", Viewpoint::corner, "from the front, somewhat from above and the right"},
                         {"front", Viewpoint::front, "along -z where y points up, along +y where z does"},
                         {"back", Viewpoint::back, "from behind"},
                         {"left", Viewpoint::left, "from the left of the front"},
                         {"right", Viewpoint::right, "from the right of the front"},
                         {"top", Viewpoint::top, "from above, the front at the bottom"},
                         {"bottom", Viewpoint::bottom, "from below, the front at the top"}},
                        "Where the viewer is; far away, so that parallels stay parallel.");
    d.option("from", &RenderOptions::from, "The direction towards the viewer instead, in the world.");
    d.option("width", &RenderOptions::width, "Pixels (a count).").between(1, 8192);
    d.option("height", &RenderOptions::height, "Pixels (a count).").between(1, 8192);
    d.choice<Look>(
        "shading", &RenderOptions::shading,
        {{"sides", Look::sides, "both sides lit; inner sides orange, but of double-sided materials"},
         {"one-sided", Look::one_sided, "the usual: turned faces are dark"},
         {"absolute", Look::absolute, "absolute values: the back is shaded as the front is"},
         {"beside", Look::beside, "one-sided, and absolute to the right of it"}},
        "What the angle between a face's normal and the light does.");
    d.choice<Paint>(
        "colours", &RenderOptions::colours,
        {{"material", Paint::material, "base colour times colours of vertices and faces; no textures"},
         {"part", Paint::part, "one for each part"},
         {"normal", Paint::normal, "the face's direction, x y z as red green blue"},
         {"plain", Paint::plain, "grey"}},
        "What faces are painted with.");
    d.option(
        "attribute", &RenderOptions::attribute,
        "Paints by this attribute where a part has it: identifiers (group, failed, cut_id) apart, numbers "
        "from blue to yellow.");
    d.choice<EdgeLines>("edges", &RenderOptions::edges,
                        {{"few", EdgeLines::few, "of scenes of at most 6000 faces"},
                         {"all", EdgeLines::all, "always"},
                         {"no", EdgeLines::no, "never"}},
                        "Whether edges of faces are drawn.");
    d.choice<Ground>("background", &RenderOptions::ground,
                     {{"none", Ground::none, "transparent"},
                      {"white", Ground::white, "white"},
                      {"grey", Ground::grey, "light grey"},
                      {"black", Ground::black, "black"}},
                     "What is behind the scene.");
    d.option("point", &RenderOptions::point,
             "A side of the squares for vertices of parts without faces, in pixels.")
        .between(0.5, 100)
        .measures(Dimension::none);
    d.at_most_one({"view", "from"});
    d.at_most_one({"colours", "attribute"});
}

void verify(const RenderOptions& o, const Value& given, Problems& problems) {
    if (o.path.text != "-" && !o.path.text.ends_with(".png"))
        problems.add(mark_at(given, "path"), "E-PICTURE",
                     fmt::format("render: pictures are PNG, and '{}' does not end in .png", o.path.text),
                     "for example render: view.png");
    if (o.from && !(length(*o.from) > 0))
        problems.add(mark_at(given, "from"), "E-DIRECTION", "render: 'from' needs a direction, found 0 0 0",
                     "for example from: [1, -2, 1]");
}

PictureSettings settings_for(const RenderOptions& o, const Scene& scene, const Context& context) {
    PictureSettings s;
    s.width = static_cast<int>(o.width), s.height = static_cast<int>(o.height);
    s.viewpoint = o.view, s.from = o.from, s.paint = o.colours, s.attribute = o.attribute;
    s.edges = o.edges, s.point = o.point;
    const float grey = o.ground == Ground::white ? 1.0f : o.ground == Ground::grey ? 0.7f : 0.0f;
    if (o.ground != Ground::none) s.ground = {grey, grey, grey};
    s.shows = [&](const Part& part) { return context.selects(part, scene); };
    return s;
}

Picture taken(const RenderOptions& o, const Scene& scene, PictureSettings s) {
    if (o.shading != Look::beside) {
        s.shading = o.shading == Look::sides      ? Shading::sides
                    : o.shading == Look::absolute ? Shading::absolute
                                                  : Shading::one_sided;
        return picture_of(scene, s);
    }
    s.shading = Shading::one_sided;
    const Picture left = picture_of(scene, s);
    s.shading = Shading::absolute;
    return beside(left, picture_of(scene, s));
}

void report(const RenderOptions& o, const Picture& picture, Context& context) {
    Json& r = context.result();
    r = {{"path", o.path.text},
         {"width", picture.width},
         {"height", picture.height},
         {"faces", picture.faces},
         {"pixels_per_unit", picture.scale}};
    std::string line = fmt::format("{}: {} x {} pixels, {:.6g} a unit", o.path.text, picture.width,
                                   picture.height, picture.scale);
    if (picture.range[0] < picture.range[1]) {
        r["range"] = {picture.range[0], picture.range[1]};
        line += fmt::format(", {} from {:.6g} (blue) to {:.6g} (yellow)", o.attribute, picture.range[0],
                            picture.range[1]);
    }
    context.say(std::move(line));
    if (!o.attribute.empty() && !picture.has_attribute)
        context.warn("W-NO-ATTRIBUTE", fmt::format("render: no part has an attribute '{}'", o.attribute),
                     "facetmill info lists them");
}

Scene run(Scene scene, const RenderOptions& o, Context& context) {
    const Picture picture = taken(o, scene, settings_for(o, scene, context));
    const io::Bytes bytes = io::png(picture);
    context.run().outputs.add(context.places().output(o.path.text), bytes, context.where());
    report(o, picture, context);
    return scene;
}

const RegisterStage registered{make_stage<RenderOptions>(
    {.name = "render",
     .about = "Takes a picture: PNG, shaded by the angle between each face and the light.",
     .details =
         "The parts (those that `only` names) as large as fits, in parallel projection, each face in one "
         "shade, "
         "four samples a pixel. The light comes from the upper left of the viewer. `shading: one-sided` "
         "takes "
         "the cosine of the angle between the normal of a face and the light, so that faces whose vertices "
         "run "
         "the wrong way round are dark; `absolute` takes its absolute value, which hides that; `beside` "
         "shows "
         "both, and where they differ a face is turned (orient) or the surface wants to be two-sided. Inner "
         "sides are orange by default, so holes and turned faces are seen at once. The scene passes on "
         "unchanged. The same bytes on any number of threads. Source: the note on facets, planes, normals "
         "and "
         "rendering.",
     .examples = {"render: view.png", "render: {path: sides.png, shading: beside, background: white}",
                  "render: {path: top.png, view: top, width: 2000, height: 2000, edges: all}",
                  "render: {path: failed.png, attribute: failed}"}},
    declare, run,
    StageHooks<RenderOptions>{.files =
                                  [](const RenderOptions& o) {
                                      return StageFiles{{}, {o.path}};
                                  },
                              .verify = verify})};

} // namespace

} // namespace facetmill
