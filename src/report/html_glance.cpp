// The summary at the top of a run's page.

#include "base/text/markup.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "report/check_text.hpp"
#include "report/glance.hpp"
#include "report/html_parts.hpp"
#include "report/html_sections.hpp"

#include <fmt/format.h>

namespace facetmill::report {

namespace {

std::string total_of(const std::vector<FileRecord>& files) {
    return fmt::format("{} in {}", sized(sum_of(files).bytes), counted(files.size(), "file"));
}

} // namespace

std::string glance_section(const RunRecord& record, bool with_time) {
    std::string rows;
    const auto row = [&](const char* name, const std::string& text) {
        if (!text.empty()) rows += fmt::format("<tr><th scope=\"row\">{}</th>{}</tr>\n", name, cell(text));
    };
    if (const auto faces = face_counts(record))
        row("faces", fmt::format("{} &rarr; {}", grouped(faces->first), grouped(faces->last)));
    row("inputs", total_of(record.inputs));
    row("outputs", total_of(record.outputs));
    row("deviation", escaped(deviation_text(record)));
    row("checks", record.checks.empty() ? "none" : passed_text(record) + " passed");
    row("warnings", grouped(warning_count(record)));
    row("time", with_time
                    ? fmt::format("{}, peak memory {}", timed(record.seconds), sized(record.peak_memory))
                    : "left out so that reports are reproducible; " + code("--timings page.html") +
                          " adds times and memory");
    return table("At a glance", "", rows);
}

} // namespace facetmill::report
