#include "pipeline/between_stages.hpp"
#include "pipeline/observers.hpp"

namespace facetmill::pipeline {

void watch_invariants(Engine& engine) {
    if (!engine.settings.check_invariants) return;
    engine.watches.push_back({Event::Kind::enters, nullptr, [](const Event& event) {
                                  check_left(*event.step, *event.left, *event.scene);
                              }});
    engine.watches.push_back(
        {Event::Kind::ran, nullptr, [](const Event& event) { check_invariants(*event.step, *event.scene); }});
}

} // namespace facetmill::pipeline
