#include "geometry/inspect/inspect.hpp"
#include "pipeline/observers.hpp"
#include "report/render.hpp"
#include "report/scene_picture.hpp"

namespace facetmill::pipeline {

void watch_record(Engine& engine) {
    const auto inspected = [&](const Event& event) {
        const ProgressScope share = engine.beside_stages("inspection of the result");
        engine.record().final_properties = report::scene_json(*event.scene, inspect(*event.scene));
    };
    const auto fails = [&](const Event& event) { return fails_check(engine, event); };
    if (makes_page(engine) || !engine.plan.reports.empty()) {
        engine.watches.push_back({Event::Kind::ended, "the inspection at the end", inspected});
        for (const auto kind : {Event::Kind::after, Event::Kind::judged})
            engine.watches.push_back({kind, "the inspection after a failed check", inspected, fails});
    }
    if (!engine.settings.last_picture || makes_page(engine)) return;
    const auto pictured = [&record = engine.record()](const Event& event) {
        record.stages.back().picture = report::small_picture(*event.scene, record.not_drawn);
    };
    const auto wanted = [&](const Event&) {
        return !engine.failures.any() && !engine.record().stages.empty();
    };
    engine.watches.push_back({Event::Kind::ended, "a picture", pictured, wanted});
}

} // namespace facetmill::pipeline
