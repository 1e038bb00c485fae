#pragma once
// Plans a pipeline from a text, for tests of the language.

#include "pipeline/document.hpp"
#include "pipeline/plan.hpp"

namespace facetmill {

struct Planned {
    pipeline::Plan plan;
    std::string problems; ///< the messages as text, one after the other
};

inline Planned planned(const std::string& text, pipeline::PlanSettings settings = {},
                       const std::string& name = "p.yaml") {
    Problems problems;
    settings.name = name;
    const auto source = std::make_shared<const SourceText>(SourceText{name, text});
    const Value document = pipeline::parse_yaml(source, problems);
    Planned out;
    if (!problems.any_errors()) out.plan = pipeline::make_plan(document, settings, problems);
    for (const auto& d : problems.all()) out.problems += (out.problems.empty() ? "" : "\n") + render(d);
    return out;
}

/// The same after the two lines that begin every pipeline. The stages must be indented.
inline Planned planned_stages(const std::string& stages, pipeline::PlanSettings settings = {}) {
    return planned("facetmill: 1\nstages:\n" + stages, std::move(settings));
}

} // namespace facetmill
