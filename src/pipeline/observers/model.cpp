#include "pipeline/observers.hpp"

namespace facetmill::pipeline {

void watch_model(Engine& engine) {
    if (!engine.settings.model_row) return;
    const char* const what = "the measures of the model";
    const auto measured = [&engine, what](const Event& event, bool walls) {
        const ProgressScope share = engine.beside_stages(what);
        ModelRowSettings settings = *engine.settings.model_row;
        settings.walls = settings.walls && walls;
        engine.record().model = model_row(*event.scene, settings);
    };
    const auto whole = [measured](const Event& event) { measured(event, true); };
    // A stage that fails later consumes its scene. Measuring walls twice would take too long.
    const auto loaded = [measured](const Event& event) { measured(event, false); };
    const auto loads = [](const Event& event) { return event.step->info->loads; };
    const auto fails = [&engine](const Event& event) { return fails_check(engine, event); };
    auto& watches = engine.watches;
    watches.push_back({Event::Kind::after, what, loaded, loads});
    watches.push_back({Event::Kind::after, what, whole, fails});
    watches.push_back({Event::Kind::judged, what, whole, fails});
    watches.push_back({Event::Kind::ended, what, whole});
}

} // namespace facetmill::pipeline
