#include "base/text/readable_numbers.hpp"
#include "diff/likeness.hpp"
#include "io/images/png.hpp"
#include "stage/options/synonyms.hpp"
#include "stage/read_recorded.hpp"
#include "stage/stage.hpp"
#include "stages/look/help.hpp"

#include <cmath>
#include <fmt/format.h>

namespace facetmill::look_stage {

namespace {

struct LookOptions {
    std::optional<Ratio> max;
    std::int64_t pixels = 512;
    std::optional<PathText> path, with;
};

void declare(Declare<LookOptions>& d) {
    d.option("max", &LookOptions::max, "The largest allowed difference. Default: only report it.")
        .also_called("look difference threshold tolerance")
        .above(0)
        .at_most(1)
        .primary();
    d.option("pixels", &LookOptions::pixels, "The sides of each picture.")
        .also_called("size resolution")
        .between(16, 2048);
    d.option("path", &LookOptions::path, "The PNG file for the pictures.").also_called(path_synonyms);
    d.option("with", &LookOptions::with, "The mesh file to compare with. Default: the scene as loaded.")
        .also_called(with_synonyms);
}

struct LookReport {
    double difference = 0, similarity = 1;
    std::int64_t pixels = 0;
};

void declare_report(DeclareFields<LookReport>& d) {
    d.field("difference", &LookReport::difference,
            "The root mean square difference of the pictures, as a share of the full range.")
        .unit("percent");
    d.field("structural_similarity", &LookReport::similarity, "1 for equal pictures.");
    d.field("pixels", &LookReport::pixels, "The sides of the pictures.");
    d.tell([](const LookReport& r) {
        return std::vector<std::string>{fmt::format("pictures of {} pixels from 8 sides differ by {}, "
                                                    "structural similarity {:.4f}",
                                                    r.pixels, percentage(r.difference), r.similarity)};
    });
}

Scene run(Scene scene, const LookOptions& o, Context& context, LookReport& report) {
    const Scene other = o.with ? read_beside(*o.with, scene, context) : Scene{};
    const Scene* loaded = o.with ? &other : context.loaded_scene();
    if (!loaded || loaded->parts.empty())
        throw Error(ErrorKind::stage, "E-LOOK", "look: there is no scene to compare with",
                    "load a mesh before look, or give one as with");
    using report::Likeness;
    const Likeness before(*loaded, static_cast<int>(o.pixels), Likeness::Views::eight);
    const Likeness::Comparison found = before.compared(scene);
    report.difference = 100 * std::sqrt(found.difference);
    report.similarity = found.similarity;
    report.pixels = o.pixels;
    const bool passed = !o.max || report.difference <= 100 * o.max->value;
    if (o.path && passed) context.output(o.path->text, io::png(found.sheet));
    // Outputs of a failed run are removed, but these pictures show why it failed.
    if (o.path && !passed) io::write_now(context.places().output(o.path->text), io::png(found.sheet));
    if (!o.max) return scene;
    report::Check check{
        .name = "look", .passed = passed, .expected = "at most " + percentage(100 * o.max->value)};
    check.found = report.difference;
    check.found_words = percentage(report.difference);
    check.max = 100 * o.max->value;
    if (!check.passed)
        check.hint = o.path ? fmt::format("see {}; keep more triangles or larger textures", o.path->text)
                            : "keep more triangles or larger textures; path makes pictures of the difference";
    context.check(std::move(check));
    return scene;
}

struct LookStage : StageOf<run> {
    StageFiles files() const override {
        StageFiles files;
        if (o.with) files.inputs.push_back(*o.with);
        if (o.path) files.outputs.push_back(*o.path);
        files.evidence = o.path;
        return files;
    }
    bool takes_from_load() const override { return !o.with; }
};

const RegisterStage registered = make_stage<LookStage>(
    {.name = "look",
     .also_called = "compare ssim psnr similarity looks_same",
     .about = help::look::about,
     .details = help::look::details,
     .examples = {"look: 5%", "look: {max: 5%, path: look.png}", "look: {with: original.glb}"},
     .checks = true,
     .tells = true,
     .keeps_scene = true,
     .lines = LinesPolicy::work},
    declare, declare_report);

} // namespace

} // namespace facetmill::look_stage
