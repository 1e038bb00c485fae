#include "pipeline/observers.hpp"

#include <algorithm>

namespace facetmill::pipeline {

void watch_view(Engine& engine, report::PageView& view) {
    if (!makes_page(engine)) return;
    const char* const what = "the 3D view";
    const report::RunRecord& record = engine.record();
    const auto fails = [&](const Event& event) { return fails_check(engine, event); };
    const auto failed = [&](const Event& event) { view.failed(event.step->name, *event.scene); };
    const auto written = [&](const Event& event) {
        for (std::size_t i = event.first_output; i < record.outputs.size(); ++i)
            if (io::codec_for(record.outputs[i].path)) view.written(*event.scene, record.outputs[i].path);
    };
    const auto no_load = [](const Event& event) { return !event.step->info->loads; };
    auto& watches = engine.watches;
    watches.push_back(
        {Event::Kind::before, what, [&](const Event& event) { view.before(*event.scene); }, no_load});
    watches.push_back({Event::Kind::after, what, failed, fails});
    watches.push_back({Event::Kind::after, what, written, no_load});
    watches.push_back({Event::Kind::judged, what, failed, fails});
    watches.push_back({Event::Kind::ended, what, [&](const Event& event) { view.at_end(*event.scene); }});
}

} // namespace facetmill::pipeline
