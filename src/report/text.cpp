#include "base/text/markup.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "report/check_text.hpp"
#include "report/render.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace facetmill::report {

namespace {

/// "12,000 -> 3,000 faces", or one number if unchanged; vertices if there are no faces (a point cloud).
std::string size_change(const StageRecord& stage) {
    const Brief none;
    const Brief &before = stage.before ? *stage.before : none, &after = stage.after ? *stage.after : none;
    const bool cloud = before.faces == 0 && after.faces == 0 && before.vertices + after.vertices > 0;
    const auto size = [&](const Brief& b) { return cloud ? b.vertices : b.faces; };
    const auto counted = [&](const Brief& b) {
        return grouped(size(b)) + " " +
               (cloud ? noun_for(size(b), "vertex", "vertices") : noun_for(size(b), "face"));
    };
    if (!stage.after) return counted(before) + " -> failed";
    if (size(before) == size(after)) return counted(after);
    return size(before) == 0 ? "-> " + counted(after) : grouped(size(before)) + " -> " + counted(after);
}

enum class Form { report, terminal };
constexpr std::size_t most_lines = 20; ///< lines per stage on a terminal

void add_warning(const Diagnostic& warning, const std::string& lead, Painted& out) {
    out += fmt::format("{}warning[{}]: {}\n", lead, warning.id, warning.message);
    if (!warning.hint.empty()) out += fmt::format("{}hint: {}\n", lead, warning.hint);
}

void add_stage(const StageRecord& stage, std::size_t width, Form form, Painted& out) {
    const std::string name = fmt::format("{:<{}}", stage.name, width);
    const std::string lead = fmt::format("  {:<{}}  ", "", width);
    if (stage.skipped) {
        out += fmt::format("  {}  ", name);
        out.paint("2", "skipped") += "\n";
        return;
    }
    if (form == Form::terminal)
        out += fmt::format("  {}  {:<34} {:>9}\n", name, size_change(stage), timed(stage.seconds));
    else
        out += fmt::format("  {}  {}\n", name, size_change(stage));
    const std::size_t all = stage.said.size(),
                      told = form == Form::report || all <= most_lines + 1 ? all : most_lines;
    for (std::size_t i = 0; i < told; ++i) out += fmt::format("{}  {}\n", lead, stage.said[i]);
    if (told < all)
        out += fmt::format("{}  and {} more lines (--report run.txt lists all)\n", lead, grouped(all - told));
    if (form == Form::terminal) return;
    for (const auto& warning : stage.warnings) add_warning(warning, lead, out);
}

/// A terminal has already shown the failed ones.
void add_checks(const std::vector<Check>& checks, Form form, Painted& out) {
    if (checks.empty()) return;
    const auto failed = std::count_if(checks.begin(), checks.end(), [](const auto& c) { return !c.passed; });
    const auto known = std::count_if(checks.begin(), checks.end(), [](const auto& c) { return c.waived; });
    out += fmt::format("checks: {} passed, {}{} failed\n",
                       static_cast<std::ptrdiff_t>(checks.size()) - failed - known,
                       known > 0 ? fmt::format("{} known, ", known) : "", failed);
    for (const auto& c : checks) {
        if ((c.passed && !c.waived) || (!c.passed && form == Form::terminal)) continue;
        const std::string where = locations_text(c);
        out += "  ";
        if (c.waived)
            out.paint("2", outcome(c));
        else
            out += outcome(c);
        out += fmt::format(" {} ({}{}): expected {}, found {}{}\n", c.name, c.stage,
                           (c.part.empty() ? "" : ", part " + c.part) +
                               (c.file.empty() ? "" : ", file " + c.file),
                           c.expected, found_text(c), where.empty() ? "" : "; " + where);
    }
}

/// A line for each file; for a folder with many files (the tiles of a tileset), a single line.
std::string files_written(const std::vector<FileRecord>& files) {
    struct InFolder {
        std::size_t count = 0, bytes = 0;
        bool told = false;
    };
    constexpr std::size_t many = 16;
    const auto folder_of = [](const FileRecord& file) {
        return file.path.substr(0, file.path.find_last_of('/') + 1);
    };
    std::map<std::string, InFolder> folders;
    for (const auto& file : files) {
        InFolder& folder = folders[folder_of(file)];
        ++folder.count;
        folder.bytes += file.bytes;
    }
    std::string out;
    for (const auto& file : files) {
        const std::string name = folder_of(file);
        InFolder& folder = folders[name];
        if (folder.count <= many)
            out += fmt::format("wrote {} ({})\n", file.path, sized(file.bytes));
        else if (!std::exchange(folder.told, true))
            out += fmt::format("wrote {} files in {}: {} ... ({})\n", grouped(folder.count),
                               name.empty() ? "the output folder" : name, file.path.substr(name.size()),
                               sized(folder.bytes));
    }
    return out;
}

/// Name and stages, without a line end.
void begin(const RunRecord& record, Form form, Painted& out) {
    out.paint("1", record.pipeline) += (record.about.empty() ? "" : ": " + record.about) + "\n";
    constexpr std::size_t widest = 40;
    std::size_t width = 8;
    for (const auto& stage : record.stages) width = std::max(width, stage.name.size());
    for (const auto& stage : record.stages) add_stage(stage, std::min(width, widest), form, out);
    if (form == Form::report)
        for (const auto& warning : record.warnings) add_warning(warning, "  ", out);
    add_checks(record.checks, form, out);
    out += files_written(record.outputs);
}

/// After a failure: a report can fail after the outputs were written.
std::string outputs_left(const RunRecord& record) {
    return record.outputs.empty() ? "; no output was written" : "";
}

} // namespace

std::string to_text(const RunRecord& record) {
    Painted out(false);
    begin(record, Form::report, out);
    if (record.exit_code == 0) return (out += "ok\n").text();
    const std::string why = record.errors.empty() ? ""
                                                  : fmt::format(": [{}] {}", record.errors.front().id,
                                                                record.errors.front().message);
    const std::string more =
        record.errors.size() > 1 ? fmt::format(" (and {} more)", record.errors.size() - 1) : "";
    out += fmt::format("failed{}{}{}; exit code {}\n", why, more, outputs_left(record), record.exit_code);
    return out.text();
}

Painted to_terminal(const RunRecord& record, bool colour) {
    Painted out(colour);
    begin(record, Form::terminal, out);
    for (const auto& report : record.reports) out += fmt::format("report {}\n", report);
    if (record.exit_code != 0)
        return out.paint("1;31", "failed") +=
               fmt::format("{}; exit code {}\n", outputs_left(record), record.exit_code);
    return out.paint("1;32", "ok") +=
           fmt::format(" in {}, peak memory {}\n", timed(record.seconds), sized(record.peak_memory));
}

} // namespace facetmill::report
