#include "base/progress.hpp"
#include "base/text/readable_numbers.hpp"
#include "stage/read_written.hpp"
#include "stages/fit/help.hpp"
#include "stages/fit/search.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <fmt/format.h>

namespace facetmill::fit_stage {

namespace {

struct ReportedImages {
    std::size_t max_size = 0;
    int quality = 0;
};

struct FitReport {
    std::size_t bytes = 0, triangles = 0, tried = 0;
    double similarity = 0, difference = 0, keep = 1;
    std::int64_t pixels = 0;
    Compression compression = Compression::meshopt;
    std::optional<Bits> bits;
    std::optional<ReportedImages> colours, normals;
    bool written = true;
};

std::string text_of(const std::optional<ReportedImages>& images, const char* what) {
    return images
               ? fmt::format("; {} of at most {} pixels, quality {}", what, images->max_size, images->quality)
               : "";
}

std::vector<std::string> lines_of(const FitReport& r) {
    const std::string bits = r.bits
                                 ? fmt::format("; bits of positions {}, normals {}, texture coordinates {}",
                                               r.bits->position, r.bits->normal, r.bits->uv)
                                 : "";
    return {fmt::format("{} {}: {} similar in pictures of {} pixels",
                        r.written ? "wrote" : "the nearest file has", sized(r.bytes),
                        percentage(r.similarity, 4), r.pixels),
            fmt::format("chosen: {} triangles ({}){}{}{}", grouped(r.triangles), percentage(100 * r.keep),
                        bits, text_of(r.colours, "images"), text_of(r.normals, "normal maps"))};
}

void declare_images(DeclareFields<ReportedImages>& d) {
    d.field("max_size", &ReportedImages::max_size, "The longest side.").unit("pixels");
    d.field("quality", &ReportedImages::quality, "The quality of the encoder.");
}

void declare_bits(DeclareFields<Bits>& d) {
    d.field("position", &Bits::position, "Bits of each coordinate.");
    d.field("normal", &Bits::normal, "Bits of each component of normals.");
    d.field("uv", &Bits::uv, "Bits of texture coordinates.");
}

void declare_report(DeclareFields<FitReport>& d) {
    d.field("bytes", &FitReport::bytes, "The size of the file and of the files that it refers to.")
        .unit("bytes");
    d.field("similarity", &FitReport::similarity, "100 minus the difference.").unit("percent");
    d.field("difference", &FitReport::difference,
            "The root mean square difference of the pictures, as a share of the full range.")
        .unit("percent");
    d.field("pixels", &FitReport::pixels, "The sides of the compared pictures.");
    d.field("triangles", &FitReport::triangles, "The triangles of the file.");
    d.field("keep", &FitReport::keep, "The chosen ratio of triangles.");
    d.choice("compression", &FitReport::compression,
             {{"meshopt", Compression::meshopt, "EXT_meshopt_compression"},
              {"draco", Compression::draco, "KHR_draco_mesh_compression"},
              {"none", Compression::none, "float32"}},
             "How the meshes are compressed.");
    d.object("bits", &FitReport::bits, "The chosen bits.", declare_bits).only_when("the file is compressed");
    d.object("colours", &FitReport::colours, "The chosen size of colour images and other data.",
             declare_images)
        .only_when("images became smaller");
    d.object("normals", &FitReport::normals, "The chosen size of normal maps.", declare_images)
        .only_when("normal maps became smaller");
    d.field("trials", &FitReport::tried, "The number of trials.");
    d.field("written", &FitReport::written,
            "Whether the file was written. It is false if no choice fits. The other fields then describe the "
            "closest choice.");
    d.tell(lines_of);
}

std::optional<ReportedImages> reported(const ImageChoice& choice) {
    return choice.side > 0 ? std::optional(ReportedImages{choice.side, choice.quality}) : std::nullopt;
}

void set_result(FitReport& report, std::size_t bytes, double error) {
    report.bytes = bytes;
    report.difference = 100 * std::sqrt(error);
    report.similarity = 100 - report.difference;
}

void set_choice(FitReport& report, const Candidate& c, const FitOptions& o) {
    set_result(report, c.bytes, c.error);
    report.triangles = c.triangles;
    report.keep = c.choice.keep;
    report.pixels = o.pixels;
    report.compression = o.compression;
    if (o.compression != Compression::none) report.bits = c.choice.bits;
    report.colours = reported(c.choice.colours);
    report.normals = reported(c.choice.normals);
}

/// A limit with three digits that `value` meets.
double rounded_up(double value) {
    double step = 1;
    while (step * 1000 <= value) step *= 10;
    return std::ceil(value / step) * step;
}

/// Records failing checks. Returns true if all limits hold.
bool check_limits(const FitReport& r, const FitOptions& o, Context& context) {
    const bool small = r.bytes <= o.most_bytes(), alike = !o.look || r.difference <= 100 * o.look->value;
    report::Check check;
    if (!small) {
        check = {.name = "budget", .passed = false, .expected = "at most " + sized(o.most_bytes())};
        check.found = static_cast<std::int64_t>(r.bytes);
        check.found_words = sized(r.bytes) + (o.look ? ", the smallest found that looks the same"
                                                     : ", the smallest of all trials");
        check.max = static_cast<double>(o.most_bytes());
        check.hint = fmt::format("use budget: {:.0f}", rounded_up(static_cast<double>(r.bytes)));
        context.check(check);
    }
    if (!alike) {
        check = {.name = "look", .passed = false, .expected = "at most " + percentage(100 * o.look->value)};
        check.found = r.difference;
        check.found_words = percentage(r.difference) + ", the smallest of all trials";
        check.max = 100 * o.look->value;
        check.hint = "give a larger look, or compression: none";
        context.check(check);
    }
    return small && alike;
}

/// The parts that the stage selects.
Scene selected(const Scene& scene, const Context& context) {
    Scene out{{}, scene.materials, scene.unit, scene.up, scene.documents};
    for (const Part& part : scene.parts)
        if (context.selects(part, scene)) out.parts.push_back(part);
    return out;
}

/// Writes the chosen file, and judges its bytes and pictures.
void write_choice(const Search& search, const Candidate& chosen, const Scene& subject, Context& context,
                  FitReport& report) {
    const Trials& trials = search.trials();
    std::vector<report::PartChange> changes;
    Scene made = trials.with_images(trials.simplified(chosen.choice.keep, &changes), chosen.choice.colours,
                                    chosen.choice.normals);
    for (const report::PartChange& change : changes)
        for (const Part& part : made.parts)
            if (part.name == change.part) {
                context.attribute_changes(part, {change.change});
                break;
            }
    const std::size_t first = context.output_records().size();
    trials.write(std::move(made), chosen.choice.bits);
    context.result() = Json::object(); // the result of write
    std::size_t bytes = 0;
    for (std::size_t i = first; i < context.output_records().size(); ++i)
        bytes += context.output_records()[i].bytes;
    const Scene there = read_written(context.trail().written.back(), subject, context);
    set_result(report, bytes, search.original().difference(there));
}

Scene run(Scene scene, const FitOptions& o, Context& context, FitReport& report) {
    if (!o.budget && !o.look)
        throw Error(ErrorKind::usage, "E-MISSING", "fit: 'budget' and 'look' are both off",
                    "give budget: 500kB, look: 0.5%, or both");
    const Scene subject = selected(scene, context);
    std::vector<Compression> all{o.compression};
    if (o.compression == Compression::smallest) all = {Compression::meshopt, Compression::draco};
    std::deque<FitOptions> options; // its elements stay where they are
    std::deque<Search> searches;
    const Search* best = nullptr;
    Candidate chosen;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const ProgressScope share(static_cast<double>(i) / static_cast<double>(all.size()),
                                  static_cast<double>(i + 1) / static_cast<double>(all.size()));
        options.push_back(o);
        options.back().compression = all[i];
        Search& search = searches.emplace_back(subject, options.back(), context);
        const Candidate found = search.best(best);
        report.tried += search.trial_count();
        if (best && !search.better(found, chosen)) continue;
        best = &search;
        chosen = found;
        set_choice(report, chosen, options.back());
    }
    if (!best) return scene;
    report.written = best->fits(chosen);
    if (report.written) write_choice(*best, chosen, subject, context, report);
    check_limits(report, o, context);
    return scene;
}

struct FitStage : StageOf<run> {
    StageFiles files() const override { return files_of_fit(o); }
    void verify(const Value& given, Problems& problems) const override { verify_fit(o, given, problems); }
};

const RegisterStage registered = make_stage<FitStage>(
    {.name = "fit",
     .also_called = "budget compact squeeze",
     .about = help::fit::about,
     .details = help::fit::details,
     .examples = {"fit: {path: web.glb, budget: 500kB}", "fit: {path: web.glb, look: 0.5%}",
                  "fit: {path: web.glb, look: 1%, pixels: 1024, compression: smallest}"},
     .tells = true,
     .keeps_scene = true,
     .writes_scene = true,
     .lines = LinesPolicy::work,
     .may_lose = MayLose::all, // the scene passes through unchanged, so nothing is compared
     .crossing_faces = CrossingFacePolicy::name},
    declare_fit, declare_report);

} // namespace

} // namespace facetmill::fit_stage
