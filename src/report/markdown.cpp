#include "base/text/markup.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "facetmill_version.hpp"
#include "report/check_text.hpp"
#include "report/glance.hpp"
#include "report/markdown_parts.hpp"
#include "report/render.hpp"

#include <fmt/format.h>

namespace facetmill::report {

namespace {

using MarkdownRows = std::vector<std::vector<std::string>>;

std::string markdown_row(const std::vector<std::string>& cells) {
    std::string line = "|";
    for (const auto& cell : cells) line += fmt::format(" {} |", cell);
    return line + "\n";
}

template <class Diagnostics>
void add_diagnostics(const Diagnostics& all, const char* kind, MarkdownRows& rows) {
    for (const auto& d : all)
        rows.push_back({kind, markdown_escaped(d.id), markdown_escaped(d.message), markdown_escaped(d.hint)});
}

/// The messages except failed checks, which have a separate table.
MarkdownRows message_rows(const RunRecord& record) {
    MarkdownRows rows;
    std::vector<RunError> errors;
    for (const auto& error : record.errors)
        if (!error.of_check) errors.push_back(error);
    add_diagnostics(errors, "error", rows);
    add_diagnostics(record.warnings, "warning", rows);
    for (const auto& stage : record.stages) add_diagnostics(stage.warnings, "warning", rows);
    return rows;
}

/// The failed checks; another line gives their number.
MarkdownRows failed_rows(const RunRecord& record) {
    MarkdownRows rows;
    for (const auto& c : record.checks) {
        if (c.passed && !c.waived) continue;
        rows.push_back({outcome(c), markdown_escaped(c.file.empty() ? c.name : c.name + " of " + c.file),
                        markdown_escaped(c.expected), markdown_escaped(found_text(c)),
                        markdown_escaped(locations_text(c)), markdown_escaped(c.hint)});
    }
    return rows;
}

MarkdownRows stage_rows_of(const RunRecord& record) {
    MarkdownRows rows;
    for (const auto& stage : record.stages) {
        std::string told = stage.skipped ? "skipped" : "";
        for (const auto& line : stage.said) told += (told.empty() ? "" : "<br>") + markdown_escaped(line);
        rows.push_back({markdown_escaped(stage.name), stage.before ? grouped(stage.before->faces) : "",
                        stage.after ? grouped(stage.after->faces) : "", told});
    }
    return rows;
}

/// Faces and bytes before and after; skips kinds of bytes that neither has.
MarkdownRows glance_rows(const RunRecord& record) {
    MarkdownRows rows;
    if (const auto faces = face_counts(record))
        rows.push_back({"faces", grouped(faces->first), grouped(faces->last),
                        part_of_before(faces->first, faces->last)});
    const bool any_in = !record.inputs.empty(), any_out = !record.outputs.empty();
    const ByteSum in = sum_of(record.inputs), out = sum_of(record.outputs);
    const auto add = [&](const char* what, std::uint64_t before, std::uint64_t after) {
        if (before == 0 && after == 0) return;
        rows.push_back({what, any_in ? sized(before) : "-", any_out ? sized(after) : "-",
                        any_in && any_out ? part_of_before(before, after) : "-"});
    };
    add("bytes", in.bytes, out.bytes);
    add("bytes of geometry", in.kinds.geometry, out.kinds.geometry);
    add("bytes of textures", in.kinds.textures, out.kinds.textures);
    add("bytes of JSON", in.kinds.json, out.kinds.json);
    return rows;
}

MarkdownRows output_rows(const RunRecord& record) {
    MarkdownRows rows;
    for (const auto& file : record.outputs)
        rows.push_back({markdown_escaped(file.path), sized(file.bytes), file.sha256.substr(0, 12)});
    return rows;
}

} // namespace

std::string markdown_table(const std::string& title, const std::vector<std::string>& heads,
                           const std::vector<std::vector<std::string>>& rows) {
    if (rows.empty()) return {};
    std::string out = fmt::format("\n### {}\n\n", title) + markdown_row(heads);
    out += markdown_row(std::vector<std::string>(heads.size(), "---"));
    for (const auto& row : rows) out += markdown_row(row);
    return out;
}

std::string to_markdown(const RunRecord& record) {
    std::string out = fmt::format("## {}\n\n", markdown_escaped(record.pipeline));
    if (!record.about.empty()) out += markdown_escaped(record.about) + "\n\n";
    out += fmt::format("**{}**", verdict_text(record));
    if (!record.checks.empty()) out += fmt::format(", {} checks passed", passed_text(record));
    out += "\n";
    if (const std::string deviation = deviation_text(record); !deviation.empty())
        out += fmt::format("\nDeviation {}\n", markdown_escaped(deviation));
    out += markdown_table("At a glance", {"", "inputs", "outputs", "ratio"}, glance_rows(record));
    out += markdown_table("Errors and warnings", {"kind", "id", "message", "hint"}, message_rows(record));
    out += markdown_table("Failed checks", {"outcome", "property", "expected", "found", "locations", "hint"},
                          failed_rows(record));
    out += markdown_table("Stages", {"stage", "faces before", "faces after", "notes"}, stage_rows_of(record));
    out += markdown_table("Outputs", {"file", "size", "SHA-256"}, output_rows(record));
    return out + fmt::format("\nfacetmill {}\n", FACETMILL_VERSION);
}

} // namespace facetmill::report
