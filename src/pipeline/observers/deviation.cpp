#include "pipeline/observers.hpp"

#include <fmt/format.h>

namespace facetmill::pipeline {

void watch_deviation(Engine& engine, report::Page& page) {
    if (makes_page(engine) || !has_report(engine, ".md")) return;
    page.leave_out_pictures();
    const auto measured = [&page](const Event& event) {
        return page.is_measured(page_step(*event.step), event.first_output);
    };
    const auto judged = [&record = engine.record()](const Event& event) {
        return record.checks.size() > event.first_check;
    };
    const auto after = [&page, &engine, measured, judged](const Event& event) {
        const ProgressScope share = engine.beside_stages(fmt::format("deviation after {}", event.step->name));
        if (measured(event)) page.measure(page_step(*event.step), *event.scene, event.first_output);
        if (judged(event)) page.failures(event.step->name, *event.scene, event.first_check);
    };
    engine.watches.push_back(
        {Event::Kind::after, "the deviation", after,
         [measured, judged](const Event& event) { return measured(event) || judged(event); }});
    watch_results(engine, page, "the deviation");
}

} // namespace facetmill::pipeline
