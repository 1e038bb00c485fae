#pragma once
// One stage on a scene, its options written as in a pipeline.

#include "pipeline/document.hpp"
#include "stage/stage.hpp"

#include <memory>
#include <stdexcept>

namespace facetmill::test {

struct StageRun {
    std::unique_ptr<RunState> state = std::make_unique<RunState>();
    report::StageRecord record;
    Scene scene;
};

/// The problems of the options go out as one Error; so do the stage's.
inline StageRun run_stage(const std::string& name, const std::string& options, Scene scene) {
    const StageInfo* stage = stage_named(name);
    if (!stage) throw std::logic_error("no stage " + name);
    Problems problems;
    const auto source = std::make_shared<const SourceText>(SourceText{"test.yaml", options});
    const Value value = pipeline::parse_yaml(source, problems);
    const auto parsed = stage->make_options();
    stage->options.parse(value, parsed.get(), name, problems);
    if (stage->verify && !problems.any_errors()) stage->verify(parsed.get(), value, problems);
    problems.throw_if_any(ErrorKind::usage);
    StageRun run;
    run.record.name = run.record.stage = name;
    const PartFilter all;
    Context context(*run.state, run.record, all, scene.bounds(), {});
    run.scene = stage->run(std::move(scene), parsed.get(), context);
    return run;
}

inline Scene scene_of(Mesh mesh, Unit unit = Unit::unknown) {
    Scene scene;
    scene.unit = unit;
    scene.parts.emplace_back();
    scene.parts[0].name = "part";
    scene.parts[0].mesh = std::move(mesh);
    return scene;
}

} // namespace facetmill::test
