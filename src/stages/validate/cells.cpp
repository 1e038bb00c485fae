#include "stages/validate/cells.hpp"

#include "cells/process/inspect_cells.hpp"

#include <fmt/format.h>

namespace facetmill::validate_stage {

std::optional<std::string> why_not_on_cells(const Assertions& assertions) {
    for (const Assertion& assertion : assertions.all)
        if (!cells::inspects(*property_named(assertion.property)))
            return fmt::format("'{}' needs the whole mesh", assertion.property);
    return {};
}

void judge_cells(Assertions assertions, Severity severity, const CellFlow& flow, Context& context) {
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
