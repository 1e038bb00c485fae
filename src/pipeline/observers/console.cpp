#include "pipeline/observers.hpp"

namespace facetmill::pipeline {

void watch_console(Engine& engine) {
    const auto& on_stage = engine.settings.on_stage;
    if (!on_stage) return;
    for (const auto kind : {Event::Kind::after, Event::Kind::failed})
        engine.watches.push_back({kind, nullptr, [&](const Event& event) { on_stage(*event.stage); }});
}

} // namespace facetmill::pipeline
