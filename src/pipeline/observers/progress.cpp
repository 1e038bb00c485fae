#include "pipeline/observers.hpp"

#include <algorithm>

namespace facetmill::pipeline {

void watch_progress(Engine& engine) {
    Progress* const progress = engine.settings.progress;
    if (!progress) return;
    int expected = 0;
    for_each_step(engine.plan.steps, [&](const Step& step) { expected += step.kind == Step::Kind::stage; });
    const auto begins = [progress, expected, number = 0](const Event& event) mutable {
        ++number; // parts found at run time may add stages to the plan
        progress->stage(number, std::max(number, expected), event.step->name);
    };
    engine.watches.push_back({Event::Kind::begins, nullptr, begins});
}

} // namespace facetmill::pipeline
