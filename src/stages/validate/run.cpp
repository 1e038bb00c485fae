#include "stage/stage.hpp"
#include "stages/validate/cells.hpp"
#include "stages/validate/failed_copy.hpp"
#include "stages/validate/help.hpp"
#include "stages/validate/judge.hpp"
#include "stages/validate/profiles.hpp"
#include "stages/validate/scene_limits.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::validate_stage {

namespace {

struct ValidateOptions {
    Assertions assertions;
    Profile profile = Profile::none;
    SceneLimits limits;
    Severity severity = Severity::error;
    Per per = Per::scene;
    std::optional<PathText> baseline, mark;
    bool update_baseline = false;
};

void declare(Declare<ValidateOptions>& d) {
    declare_properties(d, &ValidateOptions::assertions, "validate");
    declare_profile(d, &ValidateOptions::profile);
    d.group("limits", &ValidateOptions::limits, "Limits for the whole scene.", declare_limits);
    d.choice("severity", &ValidateOptions::severity,
             {{"error", Severity::error, "the run fails with exit code 1"},
              {"warn", Severity::warning, "the failure is reported and the run continues"}},
             "The effect of a failed assertion.");
    d.choice(
        "per", &ValidateOptions::per,
        {{"scene", Per::scene,
          "the scene: counts are added up over the parts, and true or false must hold for every part"},
         {"part", Per::part, "each part separately"},
         {"component", Per::component, "each connected component of each part, connected through edges"}},
        "The objects that each assertion applies to.");
    d.option("baseline", &ValidateOptions::baseline,
             "A file of known failures. They are waived unless they get worse, and new failures fail.");
    d.option("update_baseline", &ValidateOptions::update_baseline,
             "Writes the failures of this run to the baseline and waives all of them.");
    d.option("mark", &ValidateOptions::mark,
             "The file for a copy of the mesh if an assertion fails, even when the run fails. Faulty faces "
             "are red and are marked in the face attribute `failed`.");
}

/// Describes baseline entries that no longer need to be waived.
std::vector<std::string> lines_of(const ValidateReport& r) {
    const std::size_t fixed = r.fixed.value_or(0), fixed_locations = r.fixed_locations.value_or(0),
                      waived_locations = r.waived_locations.value_or(0);
    if (fixed + fixed_locations == 0) return {};
    std::string text = fmt::format("{} known failures waived", r.waived.value_or(0));
    if (fixed > 0) text += fmt::format(", {} fixed", fixed);
    if (waived_locations + fixed_locations > 0)
        text += fmt::format("; {} known locations waived", waived_locations);
    if (fixed_locations > 0) text += fmt::format(", {} fixed", fixed_locations);
    // If new failures exist, an update would waive them too.
    if (!r.fails) text += ": use update_baseline to remove them from the baseline";
    return {text};
}

void declare_report(DeclareFields<ValidateReport>& d) {
    constexpr const char* given = "a baseline is given";
    d.field("waived", &ValidateReport::waived, "Known failures that were waived.").only_when(given);
    d.field("waived_locations", &ValidateReport::waived_locations, "Known locations that were waived.")
        .only_when(given);
    d.field("fixed", &ValidateReport::fixed, "Known failures that no longer occur.").only_when(given);
    d.field("fixed_locations", &ValidateReport::fixed_locations, "Known locations that no longer occur.")
        .only_when(given);
    d.tell(lines_of);
}

Scene run(Scene scene, const ValidateOptions& o, Context& context, ValidateReport& report) {
    const SceneLimits limits = profiled(o.limits, o.profile);
    JudgeSettings s{profiled(o.assertions, o.profile, limits, context.where()), limits, o.severity, o.per};
    if (o.baseline)
        s.baseline = o.update_baseline ? context.places().output(o.baseline->text)
                                       : context.places().input(o.baseline->text);
    if (o.mark) s.mark = context.places().output(o.mark->text);
    s.update_baseline = o.update_baseline;
    report = judge(scene, std::move(s), context);
    if (o.profile != Profile::none && o.severity == Severity::error && !report.fails && !o.baseline &&
        std::all_of(scene.parts.begin(), scene.parts.end(),
                    [&](const Part& part) { return context.selects(part, scene); }))
        context.found_fit(
            std::make_shared<const Purpose>(purpose_of(o.assertions, o.profile, context.where())));
    return scene;
}

struct ValidateStage : StageOf<run> {
    StageFiles files() const override {
        StageFiles files;
        if (o.baseline) (o.update_baseline ? files.outputs : files.inputs).push_back(*o.baseline);
        files.evidence = o.mark;
        return files;
    }
    void verify(const Value& given, Problems& problems) const override {
        if (o.update_baseline && !o.baseline)
            problems.add(given.mark, "E-MISSING", "validate: update_baseline needs a baseline file to write",
                         "add baseline: known.json");
        if (o.mark) verify_failed_copy(o.mark->text, given, problems);
    }
    std::string judges_written() const override { return o.limits.of_files(); }
    void on_cells(CellFlow& flow, Context& context) const override {
        judge_cells(profiled(o.assertions, o.profile, o.limits, context.where()), o.limits, o.severity, flow,
                    context);
        const ValidateReport report;
        context.report(*info->result, &report);
    }
    std::optional<std::string> why_not_on_cells() const override {
        if (profiled(o.limits, o.profile).need_whole_scene())
            return "limits other than bytes need the whole scene";
        if (o.per == Per::component) return "per: component needs the whole mesh in memory";
        if (o.baseline || o.mark) return "baseline and mark need the whole mesh in memory";
        return validate_stage::why_not_on_cells(profiled(o.assertions, o.profile, o.limits, {}));
    }
};

const RegisterStage registered = make_stage<ValidateStage>(
    {.name = "validate",
     .also_called = "check inspect info",
     .about = help::validate::about,
     .details = help::validate::details,
     .examples = {"validate", "validate: {closed: true, euler: 2}", "validate: {for: printing, per: part}",
                  "validate: {for: web, faces: {max: 5000}, baseline: known.json}",
                  "validate: {min_angle: {min: 5deg}, severity: warn, mark: failed.glb}"},
     .checks = true,
     .keeps_scene = true,
     .lines = LinesPolicy::work,
     .roles = {.baseline = "baseline", .updates_baseline = "update_baseline"}},
    declare, declare_report);

} // namespace

} // namespace facetmill::validate_stage
