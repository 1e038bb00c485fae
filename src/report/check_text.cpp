#include "report/check_text.hpp"

#include <fmt/format.h>

namespace facetmill::report {

const char* outcome(const Check& check) {
    if (check.waived) return "known";
    if (check.passed) return "passed";
    return check.severity == Severity::error ? "failed" : "warned";
}

std::string places_text(const Check& check) {
    if (!check.evidence.is_array() || check.evidence.empty() || !check.evidence[0].contains("at")) return {};
    const Json& first = check.evidence[0];
    std::string text =
        check.places ? fmt::format("{} place{}, the first ", *check.places, *check.places == 1 ? "" : "s")
                     : "first ";
    if (first.contains("face")) text += fmt::format("face {} ", first["face"].get<std::size_t>());
    if (first.contains("with")) text += fmt::format("and {} ", first["with"].get<std::size_t>());
    if (first.contains("part")) text += fmt::format("of '{}' ", first["part"].get<std::string>());
    const Json& at = first.at("at");
    return text + fmt::format("at {:.6g} {:.6g} {:.6g}", at[0].get<double>(), at[1].get<double>(),
                              at[2].get<double>());
}

} // namespace facetmill::report
