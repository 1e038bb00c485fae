#include "pipeline/observers.hpp"

#include <algorithm>

namespace facetmill::pipeline {

namespace {

int count_stages(const Steps& steps) {
    int count = 0;
    for (const auto& step : steps) {
        count += step.kind == Step::Kind::stage;
        for (const auto& arm : step.arms) count += count_stages(*arm.steps);
    }
    return count;
}

} // namespace

void watch_progress(Engine& engine) {
    Progress* const progress = engine.settings.progress;
    if (!progress) return;
    const auto begins = [progress, expected = count_stages(engine.plan.steps),
                         number = 0](const Event& event) mutable {
        ++number; // parts found at run time may bring more stages than were planned
        progress->stage(number, std::max(number, expected), event.step->name);
    };
    engine.watches.push_back({Event::Kind::begins, nullptr, begins});
}

} // namespace facetmill::pipeline
