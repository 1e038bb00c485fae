#include "base/progress.hpp"
#include "base/text/readable_numbers.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "io/gltf/contents/resolved_materials.hpp"
#include "io/gltf/read/skinned_pose.hpp"
#include "io/images/png.hpp"
#include "stage/as_loaded.hpp"
#include "stage/read_recorded.hpp"
#include "stages/render/help.hpp"
#include "stages/render/measured.hpp"

#include <fmt/format.h>

namespace facetmill::render_stage {

namespace {

std::shared_ptr<const ResolvedMaterials> looks_of(const RenderOptions& o, const Scene& scene,
                                                  Context& context) {
    if (o.colours != Paint::material || !o.attribute.empty()) return {};
    std::vector<Diagnostic> warnings;
    auto materials = io::MaterialResolver().materials(scene, warnings);
    for (const auto& w : warnings) context.warn(w.id, "render: " + w.message, w.hint);
    return materials;
}

/// A picture of two scenes side by side. The camera shows all of both, from the first scene's viewpoint.
/// Both use the first scene's colour range.
Picture both(const PictureSettings& first, const Scene& a, const Scene& b,
             const std::shared_ptr<const ResolvedMaterials>& looks_b) {
    PictureSettings settings = first;
    Camera camera = camera_of(a, settings);
    settings.camera = camera;
    PictureSettings second = settings;
    second.shows = {};
    second.materials = looks_b;
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

/// The scenes to draw: the input scenes, or copies with measured numbers.
struct Subject {
    std::optional<Scene> own, other; ///< own: replaces the given scene
    const Quantity* quantity = nullptr;
    std::size_t faces = 0; ///< the number of faces before large faces were cut
};

/// The tree of a scene's surface.
FaceTree tree_of(const Scene& scene) {
    return FaceTree(surface_or_points_of(scene, filled_surface), FaceTree::Use::near);
}

void pose(std::optional<Scene>& scene) {
    if (auto posed = io::posed(*scene)) scene = std::move(posed);
}

/// Measures deviation between both scenes, or from the scene as loaded.
void measure(const RenderOptions& o, const Scene& scene, Subject& subject, Context& context) {
    const Quantity& quantity = *subject.quantity;
    const auto selects = [&](const Part& part) { return context.selects(part, scene); };
    const bool bind = io::posed(scene) || (subject.other && io::posed(*subject.other));
    std::optional<FaceTree> from, from_scene;
    if (quantity.compares) {
        if (subject.other)
            from = tree_of(*subject.other);
        else
            from.emplace(surface_as_loaded(context), FaceTree::Use::near);
    }
    subject.own = measured(o, quantity, scene, selects, from ? &*from : nullptr, bind);
    if (!subject.other) return;
    if (quantity.compares) from_scene = tree_of(*subject.own);
    const auto all = [](const Part&) { return true; };
    subject.other = measured(o, quantity, *subject.other, all, from_scene ? &*from_scene : nullptr, bind);
}

std::size_t faces_drawn(const Scene& scene, const Subject& subject, const Context& context) {
    std::size_t count = subject.other ? subject.other->face_count() : 0;
    for (const Part& part : scene.parts)
        if (context.selects(part, scene)) count += part.mesh.face_count();
    return count;
}

Subject subject_of(const RenderOptions& o, const Scene& scene, Context& context) {
    Subject subject;
    if (o.with) subject.other = read_beside(*o.with, scene, context);
    subject.faces = faces_drawn(scene, subject, context);
    subject.quantity = quantity_to_measure(o, scene, subject.other ? &*subject.other : nullptr, context);
    if (subject.quantity) measure(o, scene, subject, context);
    if (subject.other) pose(subject.other);
    if (subject.own)
        pose(subject.own);
    else
        subject.own = io::posed(scene);
    return subject;
}

/// The relative error of quantities measured on float32 positions.
constexpr double lost_by_floats = 1e-6;

PictureSettings settings_of(const RenderOptions& o, const Scene& scene, const Quantity* quantity,
                            Context& context) {
    PictureSettings common = common_settings(o, scene, context);
    common.unit = unit_of_legend(o, quantity, scene.unit, context);
    const Quantity* named =
        quantity ? quantity : quantity_named(o.attribute); // the stage measure may have stored the quantity
    common.range.diverging = named && named->is_signed;
    if (!quantity) return common;
    common.range.lost = lost_by_floats;
    common.attribute = quantity->name;
    common.shows = {}; // shows all measured parts
    if (quantity->compares && o.edges != EdgeLines::all) common.edges = EdgeLines::no; // faces were cut
    return common;
}

/// Widens the automatic range if all deviations are below float32 precision, so that they have no colour.
void widen_to_floats(const Scene& scene, PictureSettings& settings) {
    if (settings.range.kind != ColourRange::Kind::automatic) return;
    const ValueRange found = value_range(scene, settings.attribute, settings.range, settings.shows);
    const double least = lost_by_floats * scene.bounds().diagonal();
    if (found.known && found.high < least) settings.range = {ColourRange::Kind::given, -least, least, true};
}

void warn_of_crowd(const Scene& scene, const PictureSettings& settings, Context& context) {
    const auto crowd = crowd_of(scene, settings);
    if (!crowd) return;
    const Vec3& p = crowd->middle;
    context.warn("W-FAR", "render: " + crowd_in_words(*crowd),
                 fmt::format("use render: {{path: near.png, at: [{}], zoom: {}}} to see it, or clean: "
                             "{{components: {{keep: 1}}}} to keep only the largest component",
                             readable(p, ", "), crowd->zoom));
}

Picture taken(const RenderOptions& o, const Scene& given, const Subject& subject, Context& context) {
    const Scene& scene = subject.own ? *subject.own : given;
    PictureSettings common = settings_of(o, given, subject.quantity, context);
    common.materials = looks_of(o, scene, context);
    if (subject.quantity && subject.quantity->compares) widen_to_floats(scene, common);
    if (!o.zoom && !o.at) warn_of_crowd(scene, common, context);
    const Shots shots = shots_of(o, scene, common);
    std::vector<Picture> pictures;
    ProgressSteps steps(std::vector<double>(shots.settings.size(), 1));
    const auto looks_of_other = subject.other ? looks_of(o, *subject.other, context) : nullptr;
    for (const auto& settings : shots.settings) {
        pictures.push_back(subject.other ? both(settings, scene, *subject.other, looks_of_other)
                                         : picture_of(scene, settings));
        steps.next();
    }
    if (pictures.size() == 1) return std::move(pictures.front());
    return sheet_of(pictures, subject.other ? 1 : shots.columns);
}

struct RenderReport {
    std::string path, attribute;
    bool percentiles = false, measured = false;
    int width = 0, height = 0;
    std::size_t faces = 0;
    double scale = 0;
    ValueRange values{};

    std::optional<std::array<double, 2>> painted() const { return pair(values.low, values.high); }
    std::optional<std::array<double, 2>> all() const { return pair(values.min, values.max); }

  private:
    std::optional<std::array<double, 2>> pair(double a, double b) const {
        return values.known && values.low < values.high ? std::optional(std::array{a, b}) : std::nullopt;
    }

  public:
};

void declare_report(DeclareFields<RenderReport>& d) {
    d.field("path", &RenderReport::path, "The path of the file, as you gave it.");
    d.field("width", &RenderReport::width, "The size of the image.").unit("pixels");
    d.field("height", &RenderReport::height, "The size of the image.").unit("pixels");
    d.field("faces", &RenderReport::faces, "Faces of the drawn parts.");
    d.field("pixels_per_unit", &RenderReport::scale,
            "Pixels per scene unit. 0 if the drawn scene has no extent.");
    d.field("range", &RenderReport::painted,
            "The attribute values at the ends of the scale: blue and yellow, or blue and red.")
        .only_when("an attribute with different values was drawn");
    d.field("all_values", &RenderReport::all, "The smallest and the largest value of the attribute.")
        .only_when("an attribute with different values was drawn");
    d.field("percentiles", &RenderReport::percentiles,
            "Whether range uses the 1st to the 99th percentile. If range is symmetric around 0, it uses the "
            "99th percentile of the absolute values.");
    d.field("attribute", &RenderReport::attribute, "The attribute that was drawn. Empty if none was drawn.");
    d.field("measured", &RenderReport::measured,
            "Whether render measured the attribute because the scene does not have it.");
    d.field(
        "missing", [](const RenderReport& r) { return r.values.missing; },
        "Faces or vertices without a value. They are pink.");
    d.tell([](const RenderReport& r) {
        std::string line = fmt::format("{}: {} x {} pixels", r.path, r.width, r.height);
        if (r.scale > 0) line += fmt::format(", {:.6g} a unit", r.scale);
        if (const auto range = r.painted())
            line += fmt::format(", {} from {:.6g} (blue) to {:.6g} ({})", r.attribute, (*range)[0],
                                (*range)[1], r.values.diverging ? "red" : "yellow");
        else if (r.values.known)
            line += fmt::format(", {} {:.6g} everywhere", r.attribute, r.values.min);
        if (r.percentiles)
            line += fmt::format(", the {} of {:.6g} to {:.6g}",
                                r.values.diverging ? "99th percentile either way" : "1st and 99th percentile",
                                r.values.min, r.values.max);
        if (r.values.missing > 0) line += fmt::format(", {} without a value (pink)", r.values.missing);
        return std::vector<std::string>{line};
    });
}

void warn_of_no_values(const Quantity* quantity, const Picture& picture, Context& context) {
    if (!quantity || picture.range.known || picture.range.missing == 0) return;
    context.warn(
        "W-NO-VALUE",
        fmt::format("render: {} has no value at any face or vertex: it has none {}", quantity->name,
                    quantity->missing.empty() ? "without faces" : quantity->missing),
        "use thicken to give a sheet walls, or clean: {holes: minimal} and orient to repair a solid");
}

void warn_of_nothing(const Scene& scene, Context& context) {
    const auto drawn = [](const Part& part) { return part.mesh.vertex_count() > 0; };
    if (std::none_of(scene.parts.begin(), scene.parts.end(), drawn))
        context.warn("W-BLANK", "render: the scene has nothing to draw, so the picture is blank",
                     "use the common key when: {vertices: {min: 1}} to skip the picture");
}

Scene run(Scene scene, const RenderOptions& o, Context& context, RenderReport& report) {
    warn_of_nothing(scene, context);
    ProgressSteps steps({9, 1});
    const Subject subject = subject_of(o, scene, context);
    const Picture picture = taken(o, scene, subject, context);
    steps.next();
    const io::Bytes bytes = io::png(picture);
    context.output(o.path.text, bytes);
    report.path = o.path.text;
    report.attribute = subject.quantity ? std::string(subject.quantity->name) : o.attribute;
    report.measured = subject.quantity != nullptr;
    report.percentiles = picture.range.percentiles;
    report.width = picture.width;
    report.height = picture.height;
    report.faces = subject.faces;
    report.scale = picture.scale;
    report.values = picture.range;
    warn_of_no_values(subject.quantity, picture, context);
    return scene;
}

struct RenderStage : StageOf<run> {
    StageFiles files() const override {
        StageFiles files{{}, {o.path}};
        if (o.with) files.inputs.push_back(*o.with);
        return files;
    }
    void verify(const Value& given, Problems& problems) const override { verify_render(o, given, problems); }
    bool compares_with_load() const override { return is_from_load(o); }
};

const RegisterStage registered = make_stage<RenderStage>(
    {.name = "render",
     .also_called = "screenshot snapshot thumbnail",
     .about = help::render::about,
     .details = help::render::details,
     .examples = {"render: view.png", "render: {path: sides.png, shading: beside, background: white}",
                  "render: {path: top.png, view: top, width: 2000, height: 2000, edges: all}",
                  "render: {path: around.png, views: turntable, width: 400, height: 400, background: light}",
                  "render: {path: before-after.png, with: before.glb, background: white}",
                  "render: {path: failed.png, attribute: failed}",
                  "render: {path: curvature.png, attribute: mean_curvature, range: [-1, 1]}",
                  "render: {path: deviation.png, attribute: deviation}"},
     .tells = true,
     .keeps_scene = true,
     .lines = LinesPolicy::work,
     .may_lose = MayLose::all, // the scene passes unchanged, so a comparison is pointless
     .crossing_faces = CrossingFacePolicy::name},
    declare_render, declare_report);

} // namespace

} // namespace facetmill::render_stage
