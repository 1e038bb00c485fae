#include "base/progress.hpp"
#include "io/convert.hpp"
#include "io/gltf/looks.hpp"
#include "io/gltf/pose.hpp"
#include "io/png.hpp"
#include "stage/read_recorded.hpp"
#include "stages/render/help.hpp"
#include "stages/render/options.hpp"

#include <fmt/format.h>

namespace facetmill::render_stage {

namespace {

std::shared_ptr<const MaterialLooks> looks_of(const RenderOptions& o, const Scene& scene, Context& context) {
    if (o.colours != Paint::material || !o.attribute.empty()) return {};
    std::vector<Diagnostic> warnings;
    auto looks = io::LookReader().looks(scene, warnings);
    for (const auto& w : warnings) context.warn(w.id, "render: " + w.message, w.hint);
    return looks;
}

/// The file that is drawn beside the scene, in the scene's convention, in pose.
Scene scene_beside(const RenderOptions& o, const Scene& scene, Context& context) {
    io::ReadSettings settings;
    settings.asset_roots = context.places().asset_roots;
    Scene other = read_recorded(context.places().input(o.with->text), settings, nullptr, context).first;
    io::convert(other, {scene.unit, scene.up});
    std::optional<Scene> posed = io::posed(other);
    return posed ? std::move(*posed) : other;
}

/// Two scenes seen by one camera, which sees all of both, from where the first is seen. Numbers of the second
/// have the colours of the first's.
Picture both(const PictureSettings& first, const Scene& a, const Scene& b,
             const std::shared_ptr<const MaterialLooks>& looks_b) {
    PictureSettings settings = first;
    Camera camera = camera_of(a, settings);
    settings.camera = camera;
    PictureSettings second = settings;
    second.shows = {};
    second.looks = looks_b;
    camera.seen.add(camera_of(b, second).seen);
    settings.camera = second.camera = camera;
    const Picture left = picture_of(a, settings);
    if (left.range.known && left.range.low < left.range.high)
        second.range = {ColourRange::Kind::given, left.range.low, left.range.high, left.range.diverging};
    const Picture right = picture_of(b, second);
    Picture sheet = sheet_of({left, right}, 2);
    sheet.faces += right.faces;
    sheet.has_attribute |= right.has_attribute;
    return sheet;
}

Picture taken(const RenderOptions& o, const Scene& given, Context& context) {
    const std::optional<Scene> posed = io::posed(given);
    const Scene& scene = posed ? *posed : given;
    const auto looks = looks_of(o, scene, context);
    const Shots shots = shots_of(o, scene, context, looks);
    std::vector<Picture> pictures;
    ShareOfSteps steps(std::vector<double>(shots.settings.size(), 1));
    std::optional<Scene> other;
    if (o.with) other = scene_beside(o, scene, context);
    const auto looks_of_other = other ? looks_of(o, *other, context) : nullptr;
    for (const auto& settings : shots.settings) {
        pictures.push_back(other ? both(settings, scene, *other, looks_of_other)
                                 : picture_of(scene, settings));
        steps.next();
    }
    if (pictures.size() == 1) return std::move(pictures.front());
    return sheet_of(pictures, other ? 1 : shots.columns);
}

struct RenderReport {
    std::string path, attribute;
    bool percentiles = false;
    int width = 0, height = 0;
    std::size_t faces = 0;
    double scale = 0;
    ValueRange values{};

    std::optional<std::array<double, 2>> painted() const { return pair(values.low, values.high); }
    std::optional<std::array<double, 2>> all() const { return pair(values.min, values.max); }

  private:
    std::optional<std::array<double, 2>> pair(double a, double b) const {
        return values.known && values.min < values.max ? std::optional(std::array{a, b}) : std::nullopt;
    }

  public:
};

void declare_report(DeclareFields<RenderReport>& d) {
    d.field("path", &RenderReport::path, "The path of the file, as given.");
    d.field("width", &RenderReport::width, "Of the image.").unit("pixels");
    d.field("height", &RenderReport::height, "Of the image.").unit("pixels");
    d.field("faces", &RenderReport::faces, "Faces of the parts that were drawn.");
    d.field("pixels_per_unit", &RenderReport::scale, "Pixels per scene unit.");
    d.field("range", &RenderReport::painted,
            "The values of the attribute at the ends of the scale, blue and yellow.")
        .only_when("an attribute with different values was drawn");
    d.field("all_values", &RenderReport::all, "The smallest and the largest value of the attribute.")
        .only_when("an attribute with different values was drawn");
    d.field("percentiles", &RenderReport::percentiles,
            "Whether range is from the 1st to the 99th percentile.");
    d.tell([](const RenderReport& r) {
        std::string line =
            fmt::format("{}: {} x {} pixels, {:.6g} a unit", r.path, r.width, r.height, r.scale);
        if (const auto range = r.painted())
            line += fmt::format(", {} from {:.6g} (blue) to {:.6g} (yellow)", r.attribute, (*range)[0],
                                (*range)[1]);
        if (r.percentiles)
            line +=
                fmt::format(", the 1st and 99th percentile of {:.6g} to {:.6g}", r.values.min, r.values.max);
        return std::vector<std::string>{line};
    });
}

void warn(const RenderOptions& o, const Picture& picture, Context& context) {
    if (!o.attribute.empty() && !picture.has_attribute)
        context.warn("W-NO-ATTRIBUTE", fmt::format("render: no part has an attribute '{}'", o.attribute),
                     "facetmill info lists them");
}

Scene run(Scene scene, const RenderOptions& o, Context& context, RenderReport& report) {
    ShareOfSteps steps({9, 1});
    const Picture picture = taken(o, scene, context);
    steps.next();
    const io::Bytes bytes = io::png(picture);
    context.output(o.path.text, bytes);
    report.path = o.path.text;
    report.attribute = o.attribute;
    report.percentiles = picture.range.percentiles;
    report.width = picture.width;
    report.height = picture.height;
    report.faces = picture.faces;
    report.scale = picture.scale;
    report.values = picture.range;
    warn(o, picture, context);
    return scene;
}

const RegisterStage registered{make_stage<RenderOptions>(
    {.name = "render",
     .about = help::render::about,
     .details = help::render::details,
     .examples = {"render: view.png", "render: {path: sides.png, shading: beside, background: white}",
                  "render: {path: top.png, view: top, width: 2000, height: 2000, edges: all}",
                  "render: {path: around.png, views: turntable, width: 400, height: 400, background: light}",
                  "render: {path: before-after.png, with: before.glb, background: white}",
                  "render: {path: failed.png, attribute: failed}",
                  "render: {path: curvature.png, attribute: mean_curvature, unit: 1/mm, range: [-1, 1]}"},
     .tells = true,
     .lines = LinesPolicy::work,
     .may_lose = MayLose::all, // the scene passes on: nothing is to be compared
     .crossing_faces = CrossingFacePolicy::name},
    declare_render, declare_report, run,
    StageHooks<RenderOptions>{.files =
                                  [](const RenderOptions& o) {
                                      StageFiles files{{}, {o.path}};
                                      if (o.with) files.inputs.push_back(*o.with);
                                      return files;
                                  },
                              .verify = verify_render})};

} // namespace

} // namespace facetmill::render_stage
