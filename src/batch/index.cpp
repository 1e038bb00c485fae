// The summary of a batch, as a page and as Markdown.

#include "base/text/markup.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/short_names.hpp"
#include "batch/words.hpp"
#include "report/form.hpp"
#include "report/html_parts.hpp"
#include "report/markdown_parts.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::batch {

namespace {

using report::cell;
using report::code;
using report::number_cell;

const char* kind_of(const Outcome& out) {
    if (out.verdict == Outcome::Verdict::failed) return "bad";
    return out.verdict == Outcome::Verdict::ok && out.warnings.empty() ? "good" : "warn";
}

std::string notes_of(const Outcome& out) {
    std::string notes;
    for (const auto& error : out.errors)
        notes += fmt::format("<div class=\"bad\">{}: {}</div>", escaped(error.id), escaped(error.message));
    for (const auto& warning : out.warnings)
        notes +=
            fmt::format("<div class=\"warn\">{}: {}</div>", escaped(warning.id), escaped(warning.message));
    for (const auto& output : out.outputs) notes += fmt::format("<div>{}</div>", code(output));
    return notes;
}

/// Embeds pictures until the page would become too large for a browser to open quickly.
std::string picture_cell(const Asset& asset, const Outcome& out, std::size_t& bytes) {
    constexpr std::size_t most = 32 << 20;
    if (out.picture.empty() || bytes + out.picture.size() > most) return cell("");
    bytes += out.picture.size();
    return cell(fmt::format("<img alt=\"{}\" style=\"width: 10rem\" src=\"data:image/png;base64,{}\">",
                            escaped(asset.name), out.picture));
}

/// The columns with values: measures of models only if a model was measured.
std::vector<const Column*> shown_columns(const Summary& summary) {
    const bool measured = std::any_of(summary.outcomes.begin(), summary.outcomes.end(),
                                      [](const Outcome& out) { return out.figures.model.measured(); });
    std::vector<const Column*> shown;
    for (const Column& column : columns())
        if (measured || !column.of_model) shown.push_back(&column);
    return shown;
}

std::string cell_of(const Column& column, const Figures& figures) {
    const auto value = column.value(figures);
    return value ? column.cell(*value) : "";
}

std::string verdict_line(const Summary& summary) {
    return fmt::format("{} of {} assets are ok; exit code {}", count(summary, Outcome::Verdict::ok),
                       summary.assets.size(), summary.exit_code);
}

} // namespace

std::string to_html(const Summary& summary) {
    const auto shown = shown_columns(summary);
    std::string rows;
    std::size_t bytes = 0;
    for (const std::size_t i : worst_first(summary)) {
        const Asset& asset = summary.assets[i];
        const Outcome& out = summary.outcomes[i];
        const std::string code_text =
            out.verdict == Outcome::Verdict::ok || out.exit_code != 0 ? std::to_string(out.exit_code) : "";
        std::string figures;
        for (const Column* column : shown) figures += number_cell(cell_of(*column, out.figures));
        rows += fmt::format(
            "<tr>{}{}{}{}{}<td class=\"notes\">{}</td></tr>\n", picture_cell(asset, out, bytes),
            cell(fmt::format("<span class=\"{}\">{}</span>", kind_of(out), verdict_word(out.verdict))),
            cell(report::path_code(asset.name)), number_cell(code_text), figures, notes_of(out));
    }
    const bool good = count(summary, Outcome::Verdict::ok) == summary.assets.size();
    std::string page = report::html_begin(short_name(summary.pipeline),
                                          fmt::format("{} assets", summary.assets.size()), summary.pipeline);
    page += fmt::format("<p class=\"verdict {}\">{}</p>\n", good ? "good" : "bad", verdict_line(summary));
    std::string heads = report::heads({"picture", "outcome", "asset", "#exit code"});
    for (const Column* column : shown) heads += report::heads({fmt::format("#{}", column->title).c_str()});
    page += report::table("Assets", heads + report::heads({"notes and outputs"}), rows);
    return page + report::html_end();
}

std::string to_markdown(const Summary& summary) {
    const auto shown = shown_columns(summary);
    std::vector<std::vector<std::string>> rows;
    for (const std::size_t i : worst_first(summary)) {
        const Outcome& out = summary.outcomes[i];
        std::string notes;
        for (const auto* all : {&out.errors, &out.warnings})
            for (const auto& d : *all)
                notes += (notes.empty() ? "" : "<br>") + markdown_escaped(d.id + ": " + d.message);
        auto& row = rows.emplace_back(
            std::vector<std::string>{verdict_word(out.verdict), markdown_escaped(summary.assets[i].name)});
        for (const Column* column : shown) row.push_back(cell_of(*column, out.figures));
        row.push_back(std::move(notes));
    }
    std::vector<std::string> heads{"outcome", "asset"};
    for (const Column* column : shown) heads.emplace_back(column->title);
    heads.emplace_back("notes");
    return fmt::format("## {}\n\n{}\n", markdown_escaped(summary.pipeline), verdict_line(summary)) +
           report::markdown_table("Assets", heads, rows);
}

std::string render_for(const std::string& path, const Summary& summary) {
    switch (report::form_of(path)) {
    case report::ReportForm::json:
        return to_json(summary).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    case report::ReportForm::html:
        return to_html(summary);
    case report::ReportForm::markdown:
        return to_markdown(summary);
    case report::ReportForm::junit:
        return to_junit(summary);
    case report::ReportForm::text:
        break;
    }
    return to_text(summary);
}

} // namespace facetmill::batch
