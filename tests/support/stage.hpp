#pragma once
// Runs one stage by its name on a scene of one part, as the pipeline would.

#include "stage/stage.hpp"

#include <stdexcept>

namespace facetmill::test {

struct StageOutcome {
    Scene scene;
    report::StageRecord record;

    const Mesh& mesh() const { return scene.parts.front().mesh; }
    std::vector<std::string> warnings() const {
        std::vector<std::string> ids;
        for (const auto& w : record.warnings) ids.push_back(w.id);
        return ids;
    }
};

/// The problems with the value, one per line: "E-RANGE message | hint".
inline std::string problems_of(const std::string& stage, const Value& value) {
    const StageInfo* info = stage_named(stage);
    if (!info) throw std::runtime_error("no stage " + stage);
    Problems problems;
    const auto options = info->make_options();
    if (info->options.parse(value, options.get(), stage, problems) && info->verify)
        info->verify(options.get(), value, problems);
    std::string text;
    for (const auto& d : problems.all())
        text += (text.empty() ? "" : "\n") + d.id + " " + d.message + (d.hint.empty() ? "" : " | " + d.hint);
    return text;
}

inline StageOutcome run_stage(const std::string& stage, const Value& value, Scene scene) {
    if (const std::string problems = problems_of(stage, value); !problems.empty())
        throw std::runtime_error(problems);
    const StageInfo* info = stage_named(stage);
    const auto options = info->make_options();
    Problems problems;
    info->options.parse(value, options.get(), stage, problems);
    RunState state;
    StageOutcome run;
    const PartFilter all;
    Context context(state, run.record, all, scene.bounds(), {});
    run.scene = info->run(std::move(scene), options.get(), context);
    return run;
}

inline Scene scene_of(Mesh mesh) {
    Scene scene;
    scene.parts.emplace_back().name = "part";
    scene.parts.front().mesh = std::move(mesh);
    return scene;
}

inline Value options(std::vector<std::pair<std::string, std::string>> pairs) {
    Value map = Value::map({});
    for (auto& [key, text] : pairs) map.set(key, Value::scalar(text));
    return map;
}

} // namespace facetmill::test
