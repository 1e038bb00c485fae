#include "io/png.hpp"
#include "stages/render/options.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

using Look = RenderOptions::Look;

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
    const Picture picture = taken(o, scene, picture_settings(o, scene, context));
    const io::Bytes bytes = io::png(picture);
    context.output(o.path.text, bytes);
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
    declare_render, run,
    StageHooks<RenderOptions>{.files =
                                  [](const RenderOptions& o) {
                                      return StageFiles{{}, {o.path}};
                                  },
                              .verify = verify_render})};

} // namespace

} // namespace facetmill
