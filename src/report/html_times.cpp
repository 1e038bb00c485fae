// Times and memory on a page, and the source of its numbers: the pipeline and its command.

#include "base/text/markup.hpp"
#include "base/text/readable_numbers.hpp"
#include "report/html_parts.hpp"
#include "report/html_sections.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

std::string bar(double share) {
    return fmt::format("<td class=\"share\"><span style=\"width:{:.1f}%\"></span></td>",
                       100 * std::clamp(share, 0.0, 1.0));
}

} // namespace

std::string times_section(const RunRecord& record) {
    std::string rows;
    double stages = 0;
    const auto row = [&](const std::string& name, double seconds, std::size_t memory) {
        const double share = record.seconds > 0 ? seconds / record.seconds : 0;
        rows += fmt::format("<tr>{}{}{}{}{}</tr>\n", cell(name), number_cell(timed(seconds)),
                            number_cell(percentage(100 * share)), bar(share),
                            number_cell(memory > 0 ? sized(memory) : "-"));
    };
    for (const StageRecord& stage : record.stages) {
        stages += stage.seconds;
        if (!stage.skipped) row(escaped(stage.name), stage.seconds, stage.peak_memory);
    }
    row("<em>everything else, including the pictures of this page</em>",
        std::max(0.0, record.seconds - stages), 0);
    row("<strong>total</strong>", record.seconds, record.peak_memory);
    return table("Time and memory", heads({"stage", "#time", "#share", "", "#peak memory so far"}), rows) +
           fmt::format(
               "<p class=\"soft\">Measured on {} {}. These numbers differ from run to run, so reports "
               "leave them out. Results from the cache take almost no time.</p>\n",
               record.threads, record.threads == 1 ? "thread" : "threads");
}

std::string source_section(const RunRecord& record) {
    constexpr std::size_t most = 32768;
    std::string out;
    const auto text = [](const std::string& title, const std::string& shown) {
        return fmt::format("<h2>{0}</h2>\n<pre tabindex=\"0\" role=\"group\" aria-label=\"{0}\">{1}</pre>\n",
                           title, escaped(shown));
    };
    if (!record.command.empty()) out += text("Command", record.command);
    if (record.text.empty()) return out;
    out += text("Pipeline", record.text.substr(0, most));
    if (record.text.size() > most)
        out += fmt::format("<p class=\"soft\">The remaining {} are left out.</p>\n",
                           sized(record.text.size() - most));
    return out;
}

} // namespace facetmill::report
