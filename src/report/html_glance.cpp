// What people ask first of a run.

#include "base/markup.hpp"
#include "base/readable_numbers.hpp"
#include "base/words.hpp"
#include "report/check_text.hpp"
#include "report/html_parts.hpp"
#include "report/html_sections.hpp"

#include <cmath>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

struct FaceCounts {
    const StageRecord *first = nullptr, *last = nullptr;
    std::size_t warnings = 0;
};

FaceCounts counts_of(const RunRecord& record) {
    FaceCounts out{nullptr, nullptr, record.warnings.size()};
    for (const auto& stage : record.stages) {
        out.warnings += stage.warnings.size();
        if (stage.after && !out.first) out.first = &stage;
        if (stage.after) out.last = &stage;
    }
    return out;
}

std::string total_of(const std::vector<FileRecord>& files) {
    std::uint64_t bytes = 0;
    for (const auto& file : files) bytes += file.bytes;
    return fmt::format("{} in {}", sized(bytes), counted(files.size(), "file"));
}

/// Its own, or that of the stage that it is the same as; null when none was measured.
const DeviationView* deviation_of(const OutputView& view, const RunRecord& record) {
    if (view.deviation) return &*view.deviation;
    for (const StageRecord& stage : record.stages)
        if (stage.deviation && !view.same_as.empty() && stage.name == view.same_as) return &*stage.deviation;
    return nullptr;
}

/// The largest of the outputs; empty when none was measured.
std::string deviation_text(const RunRecord& record) {
    const DeviationView* worst = nullptr;
    for (const OutputView& view : record.views)
        if (const DeviationView* own = deviation_of(view, record);
            own && (!worst || std::abs(own->worst_distance) > std::abs(worst->worst_distance)))
            worst = own;
    if (!worst) return {};
    const double most = std::abs(worst->worst_distance);
    const char* caps = worst->caps > 0 ? ", without caps" : "";
    if (!(worst->diagonal > 0)) return fmt::format("{:.4g}{}", most, caps);
    constexpr double float_step = 1.0 / (1 << 24); // half the distance of floats of 32 bits, of their size
    return fmt::format(
        "{} of the diagonal, from {}{}{}", percentage(100 * most / worst->diagonal), escaped(worst->from),
        caps, most > 0 && most < float_step * worst->diagonal ? "; less than 32-bit floats hold" : "");
}

} // namespace

std::string glance_section(const RunRecord& record, bool with_time) {
    const FaceCounts counts = counts_of(record);
    std::string rows;
    const auto row = [&](const char* name, const std::string& text) {
        if (!text.empty()) rows += fmt::format("<tr><th scope=\"row\">{}</th>{}</tr>\n", name, cell(text));
    };
    if (counts.first)
        row("faces", fmt::format("{} &rarr; {}", grouped(counts.first->after->faces),
                                 grouped(counts.last->after->faces)));
    row("inputs", total_of(record.inputs));
    row("outputs", total_of(record.outputs));
    row("deviation", deviation_text(record));
    row("checks", record.checks.empty() ? "none" : passed_text(record) + " passed");
    row("warnings", grouped(counts.warnings));
    row("time", with_time
                    ? fmt::format("{}, peak memory {}", timed(record.seconds), sized(record.peak_memory))
                    : "not here, so that the same run gives the same page; " + code("--timings page.html") +
                          " writes it with times and memory");
    return table("At a glance", "", rows);
}

} // namespace facetmill::report
