// The summary of a batch as Markdown, and helpers that its reports share.

#include "base/text/markup.hpp"
#include "base/text/percent_encoded.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/short_names.hpp"
#include "base/text/words.hpp"
#include "batch/causes.hpp"
#include "batch/words.hpp"
#include "report/form.hpp"
#include "report/markdown_parts.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace facetmill::batch {

namespace fs = std::filesystem;

namespace {

fs::path whole(const fs::path& path) { return fs::absolute(path).lexically_normal(); }

/// The link from Markdown: with the address of the output folder, or relative to the report.
std::string markdown_link(const Summary& summary, const std::string& report, const std::string& file) {
    if (summary.link_base.empty()) return link_to(summary, report, file);
    const bool slash = summary.link_base.ends_with('/');
    return summary.link_base + (slash ? "" : "/") + percent_encoded(file);
}

std::string lines_of(const std::vector<OutcomeFile>& files,
                     const std::function<std::string(const OutcomeFile&)>& line) {
    std::string text;
    for (const OutcomeFile& file : files) append_item(text, line(file), "<br>");
    return text;
}

std::string count_lines(const std::vector<OutcomeFile>& files,
                        std::optional<std::uint64_t> OutcomeFile::*member) {
    return lines_of(files, [&](const OutcomeFile& f) { return f.*member ? grouped(*(f.*member)) : "-"; });
}

std::string markdown_notes(const Outcome& out) {
    std::string notes;
    if (!out.customer.empty()) notes = markdown_escaped(out.customer);
    for (const auto* all : {&out.errors, &out.warnings})
        for (const auto& d : *all) append_item(notes, markdown_escaped(d.id + ": " + d.message), "<br>");
    if (const std::string measures = measures_text(out.figures); !measures.empty())
        append_item(notes, markdown_escaped(measures), "<br>");
    return notes;
}

/// The rows of assets in a Markdown table.
class MarkdownRows {
  public:
    MarkdownRows(const Summary& summary, const std::string& path)
        : summary_(summary), path_(path), pictures_(picture_names(summary)) {}

    std::vector<std::string> heads() const {
        std::vector<std::string> all{"outcome",    "asset",  "files",     "triangles",
                                     "draw calls", "pixels", "deviation", "notes"};
        if (has_pictures()) all.insert(all.begin() + 1, "picture");
        return all;
    }
    std::vector<std::string> row(std::size_t i) const {
        const Outcome& out = summary_.outcomes[i];
        std::vector<std::string> cells{verdict_word(out.verdict)};
        const std::string name = markdown_escaped(summary_.assets[i].name);
        if (has_pictures())
            cells.push_back(pictures_[i].empty() ? ""
                                                 : fmt::format("![{}]({})", name, link(picture_path(i))));
        cells.push_back(out.reports.empty() ? name
                                            : fmt::format("[{}]({})", name, link(out.reports.front())));
        cells.push_back(lines_of(out.files, [&](const OutcomeFile& f) {
            return fmt::format("[{}]({}) {}", markdown_escaped(fs::path(f.path).filename().generic_string()),
                               link(f.path), sized(f.bytes));
        }));
        for (const auto member : {&OutcomeFile::faces, &OutcomeFile::draw_calls, &OutcomeFile::pixels})
            cells.push_back(count_lines(out.files, member));
        cells.push_back(out.deviation ? percentage(*out.deviation) : "");
        cells.push_back(markdown_notes(out));
        return cells;
    }

  private:
    bool has_pictures() const { return !summary_.picture_folder.empty(); }
    std::string link(const std::string& file) const { return markdown_link(summary_, path_, file); }
    std::string picture_path(std::size_t i) const {
        return (fs::path(summary_.picture_folder) / pictures_[i]).lexically_normal().generic_string();
    }

    const Summary& summary_;
    const std::string& path_;
    const std::vector<std::string> pictures_;
};

bool is_quiet(const Outcome& out) { return out.verdict == Outcome::Verdict::ok && out.warnings.empty(); }

std::string causes_table(const Summary& summary) {
    constexpr std::size_t most = 10;
    const auto causes = causes_of(summary);
    std::vector<std::vector<std::string>> rows;
    for (std::size_t i = 0; i < std::min(most, causes.size()); ++i)
        rows.push_back({causes[i].severity == Severity::error ? "error" : "warning",
                        markdown_escaped(name_of(causes[i])), grouped(causes[i].assets),
                        markdown_escaped(causes[i].first_asset), markdown_escaped(causes[i].first_message)});
    std::string text =
        report::markdown_table("Causes", {"kind", "cause", "assets", "first asset", "its message"}, rows);
    if (causes.size() > most) text += fmt::format("\nand {} more causes\n", causes.size() - most);
    return text;
}

} // namespace

std::string title_of(const Summary& summary) {
    std::optional<fs::path> common;
    for (const Asset& asset : summary.assets) {
        if (asset.input.empty()) continue;
        if (summary.assets.size() == 1) return short_name(asset.input.generic_string());
        const fs::path folder = whole(asset.input).parent_path();
        if (!common) {
            common = folder;
            continue;
        }
        const auto [end, other] = std::mismatch(common->begin(), common->end(), folder.begin(), folder.end());
        fs::path shared;
        for (auto part = common->begin(); part != end; ++part) shared /= *part;
        common = shared;
    }
    const std::string name = common ? common->filename().generic_string() : "";
    return name.empty() ? short_name(summary.pipeline) : name;
}

std::string link_to(const Summary& summary, const std::string& report, const std::string& file) {
    const fs::path from = report == "-" ? summary.output_dir : (summary.output_dir / report).parent_path();
    const fs::path target = whole(summary.output_dir / file);
    const fs::path relative = target.lexically_relative(whole(from / ".").parent_path());
    return percent_encoded((relative.empty() ? target : relative).generic_string());
}

std::string verdict_line(const Summary& summary) {
    return fmt::format("{} of {} assets are ok; exit code {}", count(summary, Outcome::Verdict::ok),
                       summary.assets.size(), summary.exit_code);
}

std::string measures_text(const Figures& figures) {
    std::string text;
    for (const Column& column : columns())
        if (const auto value = column.of_model ? column.value(figures) : std::optional<double>())
            append_item(text, fmt::format("{} {}", column.title, column.cell(*value)));
    return text;
}

std::vector<std::string> picture_names(const Summary& summary) {
    std::vector<std::string> names(summary.assets.size());
    std::set<std::string> used;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (summary.outcomes[i].picture.empty()) continue;
        const Asset& asset = summary.assets[i];
        std::string stem =
            asset.input.empty() ? asset.name : (asset.folder / asset.input.stem()).generic_string();
        for (char& c : stem)
            if (c == '/' || static_cast<unsigned char>(c) < 0x20) c = '-';
        std::string name = stem;
        for (int n = 2; !used.insert(name).second; ++n) name = fmt::format("{}-{}", stem, n);
        names[i] = name + ".png";
    }
    return names;
}

std::string to_markdown(const Summary& summary, const std::string& path) {
    std::string text =
        fmt::format("## {}\n\n{}\n", markdown_escaped(title_of(summary)), verdict_line(summary)) +
        causes_table(summary);
    if (summary.by_cause) return text;
    const MarkdownRows all(summary, path);
    std::vector<std::vector<std::string>> loud, quiet;
    for (const std::size_t i : worst_first(summary))
        (is_quiet(summary.outcomes[i]) ? quiet : loud).push_back(all.row(i));
    text += report::markdown_table("Assets", all.heads(), loud);
    if (quiet.empty()) return text;
    const std::string passed = report::markdown_table("Passed", all.heads(), quiet);
    if (loud.empty()) return text + passed;
    return text + fmt::format("\n<details><summary>{} passed</summary>\n{}\n</details>\n",
                              counted(quiet.size(), "asset"), passed);
}

std::string render_for(const std::string& path, const Summary& summary) {
    switch (report::form_of(path)) {
    case report::ReportForm::json:
        return to_json(summary).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    case report::ReportForm::html:
        return to_html(summary, path);
    case report::ReportForm::markdown:
        return to_markdown(summary, path);
    case report::ReportForm::junit:
        return to_junit(summary);
    case report::ReportForm::text:
        break;
    }
    return to_text(summary);
}

} // namespace facetmill::batch
