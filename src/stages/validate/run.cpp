#include "stages/validate/failed_copy.hpp"
#include "stages/validate/judge.hpp"
#include "stages/validate/profiles.hpp"
#include "stages/validate/scene_limits.hpp"
#include "stage/stage.hpp"

namespace facetmill {

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
    d.group("limits", &ValidateOptions::limits, "What the scene as a whole may hold.", declare_limits);
    d.choice("severity", &ValidateOptions::severity,
             {{"error", Severity::error, "a failed assertion fails the run, exit 1"},
              {"warn", Severity::warning, "it is reported, and the run goes on"}},
             "What a failed assertion means.");
    d.choice("per", &ValidateOptions::per,
             {{"scene", Per::scene, "sums over the parts, and truths of all parts"},
              {"part", Per::part, "each part for itself"},
              {"component", Per::component,
               "each component of each part, connected through edges, for itself"}},
             "What the assertions are about.");
    d.option("baseline", &ValidateOptions::baseline,
             "A file of known failures: those are waived, unless they got worse; new ones fail.");
    d.option("update_baseline", &ValidateOptions::update_baseline,
             "Writes the failures of this run to the baseline, and waives all of them.");
    d.option("mark", &ValidateOptions::mark,
             "When something fails: a copy of the mesh to write, the faces in question red and in the face "
             "attribute "
             "`failed`. Written also when the run fails.");
}

Scene run(Scene scene, const ValidateOptions& o, Context& context) {
    JudgeSettings s{profiled(o.assertions, o.profile, o.limits, context.where()), o.limits, o.severity,
                    o.per};
    if (o.baseline)
        s.baseline = o.update_baseline ? context.places().output(o.baseline->text)
                                       : context.places().input(o.baseline->text);
    if (o.mark) s.mark = context.places().output(o.mark->text);
    s.update_baseline = o.update_baseline;
    judge(scene, std::move(s), context);
    return scene;
}

void verify(const ValidateOptions& o, const Value& given, Problems& problems) {
    if (o.update_baseline && !o.baseline)
        problems.add(given.mark, "E-MISSING", "validate: update_baseline needs a file to write",
                     "baseline: known.json");
    if (o.mark) verify_failed_copy(o.mark->text, given, problems);
}

StageFiles files(const ValidateOptions& o) {
    StageFiles files;
    if (o.baseline) (o.update_baseline ? files.outputs : files.inputs).push_back(*o.baseline);
    return files;
}

const RegisterStage registered{make_stage<ValidateOptions>(
    {.name = "validate",
     .about = "Judges the mesh: each property given is an assertion, and a failed one fails the run.",
     .details = "Properties are given with a bound: a value (euler: 2), a truth (closed: true) or a range "
                "(faces: {max: 5000}, min_angle: {min: 5deg}). `for` adds those that a purpose needs, as "
                "far as they are not given; without properties and purpose, the mesh is to be closed, "
                "edge- and vertex-manifold, oriented, free of degenerate faces and not empty. All are "
                "judged, and all failures listed with evidence: the first (or worst) faces and points "
                "that speak against them, of measures only faces beyond the bound, and how many there "
                "are. Angles are in degrees. The mesh is passed on as it is.\n\n"
                "To introduce a gate on old assets: `baseline: known.json` with update_baseline (run "
                "--update-baseline) writes "
                "what fails today; from then on, without it, those failures are waived (known), and new "
                "ones fail. A failure is known by its check, its part and its locations: edges, faces, pairs of "
                "faces and vertices by the exact coordinates of their vertices in the part's own space, "
                "whatever their numbers and order, and components by their lowest vertex (x first, then y, z). "
                "So a fixed location that is followed by another one fails, and so do faces that were moved. "
                "What has no locations (counts, names of a limit aside) is waived while its value is no farther "
                "off. When something is no longer there, the run says so. A baseline lists up to 50000 "
                "locations a check, and of more it knows a sample, and when as many are there but others.\n\n"
                "`self_intersections` and `touching` are apart: faces run into each other when they meet "
                "inside one of them, or pass through each other at their edges; where they meet only at "
                "edges and corners, they touch, as after clean has taken an edge of four faces apart. "
                "Slicers take that, so `for: printing` does; `touching: 0` forbids it.\n\n"
                "`euler: 2` is the notes' test for a closed surface; it is one only for genus 0 and one "
                "component: V - E + F is 2 - 2g for a closed component of genus g, and the components add up. "
                "`closed: true` says it for all.",
     .examples = {"validate", "validate: {closed: true, euler: 2}", "validate: {for: printing, per: part}",
                  "validate: {for: web, faces: {max: 5000}, baseline: known.json}",
                  "validate: {min_angle: {min: 5deg}, severity: warn, mark: failed.glb}"},
     .checks = true},
    declare, run, StageHooks<ValidateOptions>{.files = files, .verify = verify})};

} // namespace

} // namespace facetmill
