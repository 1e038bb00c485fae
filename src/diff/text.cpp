#include "base/text/markup.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/short_names.hpp"
#include "diff/lines.hpp"
#include "diff/overview.hpp"
#include "facetmill_version.hpp"
#include "report/html_parts.hpp"
#include "report/html_sections.hpp"
#include "report/markdown_parts.hpp"
#include "report/viewer.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

/// True if the line is shown without `all`.
bool is_told(const Difference& d) { return !d.same || !d.compared || d.section == "geometry"; }

/// The word for a line on pages, and its colour.
struct Outcome {
    const char *text, *kind;
};

Outcome outcome_of(const Difference& d) {
    if (!d.same) return {"differs", "bad"};
    if (!d.compared) return {"not compared", "warn"};
    if (d.a != d.b) return {"allowed", "soft"}; // no limit, or within it
    return {"same", "good"};
}

/// A text; for a SHA-256, its first digits.
std::string short_digest(const std::string& text) {
    constexpr std::size_t digits = 64, enough = 12;
    const bool is_digest =
        text.size() == digits && text.find_first_not_of("0123456789abcdef") == std::string::npos;
    return is_digest ? text.substr(0, enough) + "..." : text;
}

std::string text_of(const Json& value) {
    if (value.is_null()) return "-";
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    if (value.is_number_integer() && value >= 0) return grouped(value.get<std::uint64_t>());
    if (value.is_string()) return short_digest(value.get<std::string>());
    if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
    return value.dump();
}

/// The lines below a distance: its position, and how it was measured.
std::vector<std::string> measured_lines(const Comparison& comparison) {
    const DeviationResult& d = *comparison.deviation;
    std::vector<std::string> lines;
    const bool forward = d.forward.maximum >= d.backward.maximum;
    const auto& way = forward ? d.forward : d.backward;
    if (way.maximum > 0 && std::isfinite(way.maximum)) {
        const Vec3 &p = way.from, &q = way.to;
        lines.push_back(fmt::format(
            "farthest point: {:.6g} {:.6g} {:.6g} in the {} file; nearest point in the {} file: "
            "{:.6g} {:.6g} {:.6g}",
            p.x, p.y, p.z, forward ? "first" : "second", forward ? "second" : "first", q.x, q.y, q.z));
    }
    lines.push_back(
        fmt::format("measured: {} and {} samples (rms and mean use {} and {}; seed {}), and all {} and {} "
                    "vertices; 100 % is the diagonal, {:.6g}",
                    grouped(d.forward.samples), grouped(d.backward.samples), grouped(d.forward.averaged),
                    grouped(d.backward.averaged), d.seed, grouped(d.forward.vertices),
                    grouped(d.backward.vertices), d.diagonal));
    const std::string a = comparison.geometry_a, b = comparison.geometry_b;
    if (a != "surface" || b != "surface")
        lines.push_back(fmt::format("compared: {} and {}; rms and mean of points include every point", a, b));
    return lines;
}

/// The measured lines of a section; only geometry has them.
std::vector<std::string> lines_below(const Comparison& comparison, const char* section) {
    if (section != std::string_view("geometry") || !comparison.deviation) return {};
    return measured_lines(comparison);
}

/// The note of a line, which begins with "differs" if the line decides.
std::string outcome_text(const Difference& d) {
    if (d.same) return d.note;
    return d.note.empty() ? "differs" : "differs: " + d.note;
}

std::ptrdiff_t count_different(const std::vector<const Difference*>& lines) {
    return std::count_if(lines.begin(), lines.end(), [](const auto* d) { return !d->same; });
}

/// "not compared: A: the lines".
std::vector<std::string> left_out_lines(const Comparison& comparison, const std::string& name_a,
                                        const std::string& name_b) {
    std::vector<std::string> lines;
    for (const auto& left : comparison.left_out)
        lines.push_back(fmt::format("not compared: {}: {}", left.of_a ? name_a : name_b, left.what));
    return lines;
}

} // namespace

std::string verdict_of(const Comparison& comparison) {
    if (comparison.differs()) return "differ";
    if (!comparison.complete()) return "agree in everything that was compared";
    return comparison.ignored.empty() ? "agree" : "agree in everything that was requested";
}

std::string to_text(const Comparison& comparison, const std::string& name_a, const std::string& name_b,
                    bool all) {
    std::string text = fmt::format("{} and {} {}\n", name_a, name_b, verdict_of(comparison));
    for (const auto& line : left_out_lines(comparison, name_a, name_b)) text += "  " + line + "\n";
    for (const char* section : comparison_sections) {
        const auto lines = of_section(comparison, section);
        if (lines.empty()) continue;
        const auto different = count_different(lines);
        text += fmt::format("  {}: {}{}\n", section,
                            different == 0 ? "same" : fmt::format("{} different", different),
                            comparison.ignored.contains(section) ? " (ignored)" : "");
        for (const auto* d : lines)
            if (all || is_told(*d))
                text += fmt::format("    {:<23} {:<15} {:<15} {}\n", d->name, text_of(d->a), text_of(d->b),
                                    outcome_text(*d));
        for (const auto& line : lines_below(comparison, section)) text += "    " + line + "\n";
    }
    if (!comparison.hint.empty()) text += fmt::format("  hint: {}\n", comparison.hint);
    return text;
}

namespace {

/// "surfaces", "points".
const char* geometry_text(const Comparison& comparison) {
    const std::string a = comparison.geometry_a, b = comparison.geometry_b;
    return a != b ? "files" : a == "points" ? "points" : "surfaces";
}

/// "differ in counts", with the parts that were not compared.
std::vector<std::string> head_lines(const Comparison& comparison, const std::string& name_a,
                                    const std::string& name_b) {
    std::vector<std::string> lines = left_out_lines(comparison, name_a, name_b);
    std::string verdict = verdict_of(comparison), in = differs_in(comparison);
    if (!in.empty()) verdict += " in " + in;
    const auto& d = comparison.deviation;
    if (const auto percent = d ? d->percent(d->maximum()) : 0; percent > 0)
        verdict += fmt::format("; the {} are up to {} of the diagonal apart", geometry_text(comparison),
                               percentage(percent));
    lines.insert(lines.begin(), std::move(verdict));
    if (!comparison.hint.empty()) lines.push_back("hint: " + comparison.hint);
    return lines;
}

/// "counts: 5 different (ignored)".
std::string section_title(const Comparison& comparison, const char* section) {
    const auto different = count_different(of_section(comparison, section));
    return std::string(section) + (different == 0 ? "" : fmt::format(": {} different", different)) +
           (comparison.ignored.contains(section) ? " (ignored)" : "");
}

/// Paths in documents may be broken at slashes; property names may not be broken.
std::string name_code(const std::string& name) {
    return name.find('/') == std::string::npos ? code(name) : path_code(name);
}

std::string difference_rows(const Comparison& comparison, const char* section) {
    std::string rows;
    for (const auto* d : of_section(comparison, section))
        if (is_told(*d))
            rows += fmt::format(
                "<tr>{}{}{}{}{}</tr>\n",
                cell(fmt::format("<span class=\"{}\">{}</span>", outcome_of(*d).kind, outcome_of(*d).text)),
                cell(name_code(d->name)), cell(escaped(text_of(d->a))), cell(escaped(text_of(d->b))),
                cell(escaped(d->note)));
    return rows;
}

} // namespace

std::string comparison_begin(const std::pair<std::string, std::string>& names,
                             const std::pair<std::string, std::string>& paths, const std::string& about) {
    const auto& [name_a, name_b] = names;
    std::string out = html_begin(fmt::format("{} and {}", name_a, name_b), about,
                                 fmt::format("{} and {}", paths.first, paths.second));
    if (names == paths) return out;
    return out + fmt::format("<dl><dt>first</dt><dd>{}</dd><dt>second</dt><dd>{}</dd></dl>\n",
                             path_code(paths.first), path_code(paths.second));
}

std::string comparison_heading(const std::pair<std::string, std::string>& names,
                               const std::pair<std::string, std::string>& paths) {
    std::string out =
        fmt::format("## {} and {}\n", markdown_escaped(names.first), markdown_escaped(names.second));
    if (names == paths) return out;
    return out + fmt::format("\n{} and {}\n", markdown_escaped(paths.first), markdown_escaped(paths.second));
}

std::string to_html(const Comparison& comparison, const std::string& path_a, const std::string& path_b,
                    const ComparisonPictures& pictures) {
    const auto [name_a, name_b] = short_names(path_a, path_b);
    std::string out = comparison_begin({name_a, name_b}, {path_a, path_b}, "Compared by facetmill diff.");
    const char* kind = comparison.differs() ? "bad" : "good";
    for (const auto& line : head_lines(comparison, name_a, name_b)) {
        out += fmt::format("<p class=\"verdict {}\">{}</p>\n", kind, escaped(line));
        kind = "warn";
    }
    out += "<div class=\"deviation\">" + figure(picture("first", name_a, pictures.a), name_a);
    out += compared_figure(picture("second", name_b, pictures.b), "first", name_b,
                           fmt::format("{}; left of the slider: {}", name_b, name_a)) +
           "</div>\n" + not_drawn_html(pictures.not_drawn) + viewer_section(pictures.view) +
           overview_html(comparison);
    if (pictures.backward || pictures.forward) out += "<h2>Signed distances</h2>\n";
    if (pictures.backward)
        out += "<h3>Distances of the second file from the first</h3>\n" +
               deviation_html(*pictures.backward, "backward", "the second file");
    if (pictures.forward)
        out += "<h3>Distances of the first file from the second</h3>\n" +
               deviation_html(*pictures.forward, "forward", "the first file", "the first file");
    for (const char* section : comparison_sections) {
        const std::string rows = difference_rows(comparison, section);
        out += table(section_title(comparison, section),
                     heads({"outcome", "name", "first", "second", "note"}), rows);
        if (rows.empty()) continue;
        for (const auto& line : lines_below(comparison, section))
            out += fmt::format("<p class=\"soft\">{}</p>\n", escaped(line));
    }
    return out + html_end();
}

std::string to_markdown(const Comparison& comparison, const std::string& path_a, const std::string& path_b) {
    const auto [name_a, name_b] = short_names(path_a, path_b);
    std::string out = comparison_heading({name_a, name_b}, {path_a, path_b});
    for (const auto& line : head_lines(comparison, name_a, name_b))
        out += fmt::format("\n**{}**\n", markdown_escaped(line));
    out += overview_markdown(comparison);
    std::string sections;
    for (const char* section : comparison_sections) {
        std::vector<std::vector<std::string>> rows;
        for (const auto* d : of_section(comparison, section))
            if (is_told(*d))
                rows.push_back({outcome_of(*d).text, markdown_escaped(d->name),
                                markdown_escaped(text_of(d->a)), markdown_escaped(text_of(d->b)),
                                markdown_escaped(d->note)});
        sections += markdown_table(section_title(comparison, section),
                                   {"outcome", "name", "first", "second", "note"}, rows);
        for (const auto& line : lines_below(comparison, section))
            sections += fmt::format("\n{}\n", markdown_escaped(line));
    }
    if (!sections.empty())
        out += fmt::format("\n<details><summary>Line by line</summary>\n{}\n</details>\n", sections);
    return out + fmt::format("\nfacetmill {}\n", FACETMILL_VERSION);
}

} // namespace facetmill::report
