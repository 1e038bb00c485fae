#include "base/text/markup.hpp"
#include "report/check_text.hpp"
#include "report/render.hpp"

#include <fmt/format.h>

namespace facetmill::report {

namespace {

std::string check_case(const Check& check) {
    const std::string head =
        fmt::format("    <testcase classname=\"{}\" name=\"{}{}\"", escaped(check.stage), escaped(check.name),
                    subject_text(check).empty() ? "" : escaped(fmt::format(" [{}]", subject_text(check))));
    if (check.passed && !check.waived) return head + "/>\n";
    const std::string locations = locations_text(check);
    const std::string said = escaped(fmt::format("expected {}, found {}{}", check.expected, found_text(check),
                                                 locations.empty() ? "" : "; " + locations));
    if (check.waived)
        return fmt::format("{}>\n      <system-out>known: {}</system-out>\n    </testcase>\n", head, said);
    if (check.severity != Severity::error)
        return fmt::format("{}>\n      <system-out>warning: {}</system-out>\n    </testcase>\n", head, said);
    return fmt::format("{}>\n      <failure message=\"{}\">{}</failure>\n    </testcase>\n", head, said,
                       escaped(to_string(check.where)));
}

} // namespace

std::string to_junit(const RunRecord& record) {
    std::string cases;
    std::size_t tests = 0, failures = 0, errors = 0;
    for (const auto& check : record.checks) {
        cases += check_case(check);
        ++tests;
        failures += !check.passed && check.severity == Severity::error;
    }
    for (const auto& d : record.errors) {
        if (d.of_check) continue; // already a test case
        cases += fmt::format("    <testcase classname=\"run\" name=\"{}\">\n      <error "
                             "message=\"{}\">{}</error>\n    </testcase>\n",
                             escaped(d.id), escaped(d.message), escaped(to_string(d.where)));
        ++tests;
        ++errors;
    }
    if (tests == 0) { // a run without checks is a test case too, so that it is visible
        cases = "    <testcase classname=\"run\" name=\"done\"/>\n";
        tests = 1;
    }
    return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n  <testsuite name=\"{}\" "
                       "tests=\"{}\" failures=\"{}\" errors=\"{}\">\n"
                       "{}  </testsuite>\n</testsuites>\n",
                       escaped(record.pipeline), tests, failures, errors, cases);
}

} // namespace facetmill::report
