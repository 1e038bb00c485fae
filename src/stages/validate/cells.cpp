#include "stages/validate/cells.hpp"

#include "base/text/words.hpp"
#include "cells/process/inspect_cells.hpp"

#include <fmt/format.h>

namespace facetmill::validate_stage {

std::optional<std::string> why_not_on_cells(const Assertions& assertions) {
    for (const Assertion& assertion : assertions.all)
        if (!cells::inspects(*property_named(assertion.property)))
            return fmt::format("'{}' needs the whole mesh", assertion.property);
    return {};
}

void judge_cells(Assertions assertions, const SceneLimits& limits, Severity severity, const CellFlow& flow,
                 Context& context) {
    require_written(limits, context);
    std::vector<std::string> not_judged;
    for (const WrittenScene& file : context.trail().written) {
        const auto records = std::span(context.output_records()).subspan(file.first_record, file.records);
        for (auto& limit : check_limits(limits, LimitsOf::file, {Scene{}, records})) {
            limit.check.severity = severity;
            limit.check.file = file.path;
            context.check(std::move(limit.check));
        }
        not_judged.push_back(file.path);
    }
    if (assertions.all.empty()) return;
    if (!not_judged.empty())
        context.say(fmt::format("checked the cells of the scene, not {}", join_texts(not_judged)));
    assertions = resolved(std::move(assertions), flow.outline(), context);
    Properties properties = cells::inspect_cells(*flow.partition, flow.transform, flow.means);
    properties.unit = flow.unit;
    properties.up = flow.up;
    for (report::Check& check : evaluate(assertions, properties, context.name())) {
        check.severity = severity;
        context.check(std::move(check));
    }
}

} // namespace facetmill::validate_stage
