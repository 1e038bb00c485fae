#include "pipeline/observers.hpp"

namespace facetmill::pipeline {

void watch_trace(Engine& engine, Trace& trace) {
    const auto add = [&](const Event& event, TracedStep::Way way) -> Json& {
        trace.push_back({event.step->name, event.step->info->name, event.stage->options, {}, {}, {}, way});
        return trace.back().options;
    };
    engine.watches.push_back({Event::Kind::before, nullptr, [add](const Event& event) {
                                  Json& options = add(event, TracedStep::Way::always);
                                  const auto& only = event.step->only.patterns;
                                  if (!only.empty()) options["only"] = only;
                              }});
    engine.watches.push_back(
        {Event::Kind::skipped, nullptr, [add](const Event& event) { add(event, TracedStep::Way::skipped); }});
}

} // namespace facetmill::pipeline
