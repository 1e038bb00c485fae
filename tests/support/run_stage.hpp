#pragma once
// Runs a stage on a scene as the pipeline does. Options are text as in a pipeline, or a value.

#include "mesh/shapes.hpp"
#include "pipeline/document.hpp"
#include "stage/stage.hpp"
#include "support/failure.hpp"

#include <memory>
#include <stdexcept>

namespace facetmill::test {

struct StageRun {
    std::unique_ptr<RunState> state = std::make_unique<RunState>();
    report::StageRecord record;
    Scene scene;

    const Mesh& mesh() const { return scene.parts.front().mesh; }
    std::vector<std::string> warnings() const {
        std::vector<std::string> ids;
        for (const auto& w : record.warnings) ids.push_back(w.id);
        return ids;
    }
};

inline const StageInfo& stage_for_test(std::string_view name) {
    const StageInfo* stage = stage_named(name);
    if (!stage) throw std::logic_error("no stage " + std::string(name));
    return *stage;
}

/// The stage with the given options. Adds their errors to problems.
inline std::shared_ptr<Stage> use_of(const StageInfo& info, const Value& value, Problems& problems) {
    auto stage = info.made();
    info.options->parse(value, stage->target(), info.name, problems);
    if (!problems.any_errors()) stage->verify(value, problems);
    return stage;
}

/// Throws the problems of the options as one Error, like the stage's own errors.
inline StageRun run_stage(const std::string& name, const Value& value, Scene scene) {
    Problems problems;
    const auto stage = use_of(stage_for_test(name), value, problems);
    problems.throw_if_any(ErrorKind::usage);
    StageRun run;
    run.record.name = run.record.stage = name;
    const PartFilter all;
    Context context(*run.state, run.record, all, scene.bounds(), {});
    run.scene = perform(*stage, std::move(scene), context);
    return run;
}

inline StageRun run_stage(const std::string& name, const std::string& options, Scene scene) {
    Problems problems;
    const auto source = std::make_shared<const SourceText>(SourceText{"test.yaml", options});
    const Value value = pipeline::parse_yaml(source, problems);
    problems.throw_if_any(ErrorKind::usage);
    return run_stage(name, value, std::move(scene));
}
inline StageRun run_stage(const std::string& name, const char* options, Scene scene) {
    return run_stage(name, std::string(options), std::move(scene));
}

/// The problems with the value, one per line: "E-RANGE message | hint".
inline std::string problems_of(const std::string& name, const Value& value) {
    Problems problems;
    use_of(stage_for_test(name), value, problems);
    std::string text;
    for (const auto& d : problems.all())
        text += (text.empty() ? "" : "\n") + d.id + " " + d.message + (d.hint.empty() ? "" : " | " + d.hint);
    return text;
}

inline Scene scene_of(Mesh mesh, Unit unit = Unit::unknown) {
    Scene scene;
    scene.unit = unit;
    scene.parts.emplace_back();
    scene.parts[0].name = "part";
    scene.parts[0].mesh = std::move(mesh);
    return scene;
}

/// A cube with a skin's joints and weights.
inline Scene skinned_cube() {
    Scene scene = scene_of(shapes::cube());
    scene.parts[0].skinned = true;
    scene.parts[0].mesh.attributes = {
        {"JOINTS_0", Domain::wedge, Role::joints, 4, false, std::vector<std::uint8_t>(32, 0)},
        {"WEIGHTS_0", Domain::wedge, Role::weights, 4, false, std::vector<float>(32, 0.25F)}};
    return scene;
}

/// A map of scalars, as from the command line.
inline Value options(std::vector<std::pair<std::string, std::string>> pairs) {
    Value map = Value::map({});
    for (auto& [key, text] : pairs) map.set(key, Value::scalar(text));
    return map;
}

/// The error of a stage that refuses its options, without the position in the text. The tests of the
/// document check positions.
inline std::string refusal_of(const char* stage, const std::string& options, Scene scene) {
    std::string text = failure([&] { run_stage(stage, options, std::move(scene)); });
    const auto place = text.find("test.yaml:");
    if (place != std::string::npos) text.erase(place, text.find(": ", place) + 2 - place);
    return text;
}

} // namespace facetmill::test
