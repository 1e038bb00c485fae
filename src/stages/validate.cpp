#include "stage/evidence_json.hpp"
#include "stage/failed_copy.hpp"
#include "stage/known_failures.hpp"
#include "stage/profiles.hpp"
#include "stage/scene_limits.hpp"
#include "stage/stage.hpp"

#include "geometry/surgery.hpp"
#include "mesh/placement.hpp"
#include "mesh/topology.hpp"

#include <fmt/format.h>
#include <span>

namespace facetmill {

namespace {

enum class Per { scene, part, component };

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
               "each piece of each part that is connected through edges, for itself"}},
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

/// Lends the parts at the given places to body as a scene of their own, without a copy.
template <class Body>
void with_parts(Scene& scene, std::span<const std::size_t> places, Body&& body) {
    Scene chosen{{}, scene.materials, scene.unit, scene.up, {}};
    for (const std::size_t i : places) chosen.parts.push_back(std::move(scene.parts[i]));
    body(chosen);
    for (std::size_t k = 0; k < places.size(); ++k) scene.parts[places[k]] = std::move(chosen.parts[k]);
}

class Judge {
  public:
    Judge(const ValidateOptions& o, Context& context)
        : o_(o), context_(context),
          assertions_(profiled(o.assertions, o.profile, o.limits, context.where())) {
        if (o.baseline && !o.update_baseline)
            known_ = KnownFailures::read(context.places().input(o.baseline->text));
    }

    void run(Scene& scene) {
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < scene.parts.size(); ++i)
            if (context_.selects(scene.parts[i], scene)) places.push_back(i);
        assertions_ = resolved(std::move(assertions_), scene, context_);
        for (auto& check : check_limits(o_.limits, scene)) take(std::move(check));
        if (o_.per == Per::scene) with_parts(scene, places, [&](const Scene& all) { judge(all, ""); });
        if (o_.per == Per::part)
            for (const std::size_t i : places)
                with_parts(scene, {&i, 1}, [&](const Scene& one) { judge(one, one.parts[0].name); });
        if (o_.per == Per::component)
            for (const std::size_t i : places) judge_components(scene.parts[i], scene);
        finish(scene);
    }

  private:
    void judge(const Scene& scene, const std::string& part) {
        for (auto& check : evaluate(assertions_, inspect(scene, assertions_.settings()), context_.name())) {
            check.part = part;
            if (!check.passed) check.evidence = evidence_against(scene, *property_named(check.name));
            take(std::move(check));
        }
    }

    void judge_components(const Part& part, const Scene& scene) {
        const Components pieces = face_components(part.mesh, false);
        std::size_t number = 0;
        for (Mesh& mesh : separated(part.mesh, pieces.of_face, pieces.count)) {
            Scene one{{}, scene.materials, scene.unit, scene.up, {}};
            one.parts.emplace_back().name = fmt::format("{}.{}", part.name, number++);
            one.parts[0].mesh = std::move(mesh);
            one.parts[0].transform = effective(part);
            judge(one, one.parts[0].name);
        }
    }

    void take(report::Check check) {
        check.severity = o_.severity;
        if (!check.passed) {
            failed_.add(check);
            if (o_.update_baseline || known_.waives(check)) {
                check.passed = true, check.found += " (known)";
                ++waived_;
            }
        }
        context_.check(std::move(check));
    }

    void finish(const Scene& scene) {
        if (o_.update_baseline)
            failed_.write(context_.run().outputs, context_.places().output(o_.baseline->text));
        if (o_.mark && !failed_.empty())
            write_failed_copy(scene, assertions_, context_.places().output(o_.mark->text));
        if (o_.baseline) context_.result()["waived"] = waived_;
    }

    const ValidateOptions& o_;
    Context& context_;
    Assertions assertions_;
    KnownFailures known_, failed_;
    std::size_t waived_ = 0;
};

Scene run(Scene scene, const ValidateOptions& o, Context& context) {
    Judge(o, context).run(scene);
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
     .details =
         "Properties are given with a bound: a value (euler: 2), a truth (closed: true) or a range (faces: "
         "{max: 5000}, "
         "min_angle: {min: 5deg}). `for` adds those that a purpose needs, as far as they are not given; "
         "without "
         "properties and purpose, the mesh is to be closed, edge- and vertex-manifold, oriented, free of "
         "degenerate "
         "faces and not empty. All are judged, and all failures listed with evidence: the first (or worst) "
         "faces and "
         "points that speak against them. Angles are in degrees. The mesh is passed "
         "on as it "
         "is.\n\n"
         "To introduce a gate on old assets: `baseline: known.json` with update_baseline writes what fails "
         "today; from "
         "then on, without it, those failures are waived as long as they do not get worse.\n\n"
         "`euler: 2` is the notes' test for a closed surface; it is one only for genus 0 in one piece: V - E "
         "+ F is "
         "2 - 2g for a closed piece of genus g, and the pieces add up. `closed: true` says it for all.",
     .examples = {"validate", "validate: {closed: true, euler: 2}", "validate: {for: printing, per: part}",
                  "validate: {for: web, faces: {max: 5000}, baseline: known.json}",
                  "validate: {min_angle: {min: 5deg}, severity: warn, mark: failed.glb}"},
     .checks = true},
    declare, run, StageHooks<ValidateOptions>{.files = files, .verify = verify})};

} // namespace

} // namespace facetmill
