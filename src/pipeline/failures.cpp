#include "pipeline/failures.hpp"

#include "report/check_text.hpp"

#include <algorithm>

namespace facetmill::pipeline {

void Failures::add(ErrorKind kind, report::RunError why) {
    const bool only_checks = record_.exit_code == static_cast<int>(ErrorKind::check);
    if (!any_ || (only_checks && kind != ErrorKind::check)) record_.exit_code = static_cast<int>(kind);
    any_ = true;
    record_.errors.push_back(std::move(why));
}

void Failures::add(const Error& error) {
    for (const auto& d : error.diagnostics()) add(error.kind(), {d});
}

std::optional<Diagnostic> strict_failure(const Diagnostic& warning, const std::vector<std::string>& strict) {
    const bool fails = std::any_of(strict.begin(), strict.end(),
                                   [&](const std::string& id) { return id == "*" || id == warning.id; });
    if (!fails) return {};
    return Diagnostic{Severity::error, "E-STRICT",
                      fmt::format("--strict makes {} fail: {}", warning.id, warning.message), warning.where,
                      warning.hint};
}

void Failures::warn(const Diagnostic& warning) {
    if (is_allowed(warning, allowed_)) return;
    if (auto error = strict_failure(warning, settings_.strict))
        add(ErrorKind::check, {std::move(*error)}); // includes the warning's text
    else if (settings_.on_warning)
        settings_.on_warning(warning);
}

bool Failures::judge_checks(std::size_t first) {
    bool all_hold = true;
    for (std::size_t i = first; i < record_.checks.size(); ++i) {
        const auto& check = record_.checks[i];
        if (check.passed) continue;
        const std::string locations = report::locations_text(check);
        const std::string text = fmt::format(
            "'{}' must be {}, found {}{}{}{}", check.name, check.expected, report::found_text(check),
            check.part.empty() ? "" : fmt::format(" in part '{}'", check.part),
            check.file.empty() ? "" : fmt::format(" in '{}'", check.file),
            locations.empty() ? "" : "; " + locations);
        if (check.severity == Severity::error) {
            all_hold = false;
            add(ErrorKind::check, {{Severity::error, "E-CHECK", text, check.where, check.hint}, true});
        } else {
            const Diagnostic warning{Severity::warning, "W-CHECK", text, check.where, check.hint};
            record_.warnings.push_back(warning);
            warn(warning);
        }
    }
    return all_hold;
}

} // namespace facetmill::pipeline
