#include "io/png.hpp"
#include "stages/render/help.hpp"
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

struct RenderReport {
    std::string path, attribute;
    int width = 0, height = 0;
    std::size_t faces = 0;
    double scale = 0;
    std::array<double, 2> range{};

    std::optional<std::array<double, 2>> painted() const {
        return range[0] < range[1] ? std::optional(range) : std::nullopt;
    }
};

void declare_report(DeclareFields<RenderReport>& d) {
    d.field("path", &RenderReport::path, "The path of the file, as given.");
    d.field("width", &RenderReport::width, "Of the image.").unit("pixels");
    d.field("height", &RenderReport::height, "Of the image.").unit("pixels");
    d.field("faces", &RenderReport::faces, "Faces of the parts that were drawn.");
    d.field("pixels_per_unit", &RenderReport::scale, "Pixels per scene unit.");
    d.field("range", &RenderReport::painted,
            "The smallest (blue) and largest (yellow) value of the attribute.")
        .only_when("an attribute with different values was drawn");
    d.tell([](const RenderReport& r) {
        std::string line =
            fmt::format("{}: {} x {} pixels, {:.6g} a unit", r.path, r.width, r.height, r.scale);
        if (const auto range = r.painted())
            line += fmt::format(", {} from {:.6g} (blue) to {:.6g} (yellow)", r.attribute, (*range)[0],
                                (*range)[1]);
        return std::vector<std::string>{line};
    });
}

void warn(const RenderOptions& o, const Picture& picture, Context& context) {
    if (!o.attribute.empty() && !picture.has_attribute)
        context.warn("W-NO-ATTRIBUTE", fmt::format("render: no part has an attribute '{}'", o.attribute),
                     "facetmill info lists them");
}

Scene run(Scene scene, const RenderOptions& o, Context& context, RenderReport& report) {
    const Picture picture = taken(o, scene, picture_settings(o, scene, context));
    const io::Bytes bytes = io::png(picture);
    context.output(o.path.text, bytes);
    report = {o.path.text,
              o.attribute,
              picture.width,
              picture.height,
              picture.faces,
              picture.scale,
              {picture.range[0], picture.range[1]}};
    warn(o, picture, context);
    return scene;
}

const RegisterStage registered{make_stage<RenderOptions>(
    {.name = "render",
     .about = help::render::about,
     .details = help::render::details,
     .examples = {"render: view.png", "render: {path: sides.png, shading: beside, background: white}",
                  "render: {path: top.png, view: top, width: 2000, height: 2000, edges: all}",
                  "render: {path: failed.png, attribute: failed}"},
     .crossing_faces = CrossingFacePolicy::name},
    declare_render, declare_report, run,
    StageHooks<RenderOptions>{.files =
                                  [](const RenderOptions& o) {
                                      return StageFiles{{}, {o.path}};
                                  },
                              .verify = verify_render})};

} // namespace

} // namespace facetmill
