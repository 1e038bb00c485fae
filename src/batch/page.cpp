// The page of a batch: a group of rows for each asset, with its picture and files.

#include "base/text/markup.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/spelling.hpp"
#include "base/text/words.hpp"
#include "batch/causes.hpp"
#include "batch/words.hpp"
#include "report/html_parts.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::batch {

namespace {

using report::cell;
using report::code;
using report::number_cell;

/// Styles of the table of assets. On a phone, each asset is a card.
constexpr const char* style = R"(<style>
.find { display: flex; flex-wrap: wrap; gap: .5rem 1.2rem; align-items: end; margin: .6rem 0; }
.find label { font-size: .85rem; color: var(--quiet); } .find input[type=search], .find select { display: block; font: inherit;
  color: var(--ink); background: var(--paper); border: 1px solid var(--line); border-radius: .3rem; padding: .25rem .5rem; }
.assets thead button { all: unset; cursor: pointer; font-weight: 600; } .assets thead button:focus-visible { outline: 2px solid var(--accent); }
.assets thead button::after { content: " \2195"; color: var(--quiet); } .assets [aria-sort=ascending] button::after { content: " \2191"; }
.assets [aria-sort=descending] button::after { content: " \2193"; } .assets tbody { border-bottom: 1px solid var(--line); }
.assets td, .assets tbody th { border-bottom: 0; padding-top: .25rem; padding-bottom: .25rem; } .assets td.picture { width: 8rem; }
.assets td.picture img { width: 7rem; } .assets tbody th[scope=row] { color: inherit; white-space: normal; width: 14rem; overflow-wrap: anywhere; }
.assets .file { overflow-wrap: anywhere; } .assets td.notes { min-width: 0; padding-bottom: .6rem; }
@media (max-width: 640px) { .assets thead { display: none; } .assets, .assets tbody, .assets tr, .assets td, .assets tbody th { display: block; width: auto; }
  .assets tbody { padding: .6rem 0; } .assets td, .assets td.number { text-align: left; padding: .1rem 0; } .assets td:empty { display: none; }
  .assets td.picture img { width: 100%; max-width: 16rem; } .assets td[data-head]::before { content: attr(data-head) ": "; color: var(--quiet); }
  .assets tbody th[scope=row] { width: auto; padding: .3rem 0; font-size: 1.05rem; } .assets td.file { padding-top: .5rem; font-weight: 600; } }
@media print { .find { display: none; } }
</style>
)";

/// Filters and sorts the groups of rows. Without scripts, all rows are shown.
constexpr const char* script = R"(<script>
{
  const table = document.querySelector("table.assets"), form = document.querySelector("form.find");
  const groups = [...table.tBodies], heads = [...table.querySelectorAll("thead th")], said = document.getElementById("shown");
  const { text, verdict, key, passed } = form.elements;
  const filter = () => {
    const words = text.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const group of groups) {
      const is = group.dataset.verdict, found = words.every((word) => group.dataset.text.includes(word));
      const folded = is === "passed" && !passed.checked && !words.length && verdict.value !== is;
      group.hidden = !found || folded || (verdict.value !== "" && verdict.value !== is);
      shown += !group.hidden;
    }
    said.textContent = shown + " of " + groups.length + " assets shown";
  };
  const sort = (name, down) => {
    const number = (group) => (group.dataset[name] === "" ? -1 : Number(group.dataset[name]));
    const order = (a, b) => (name === "name" ? a.dataset.name.localeCompare(b.dataset.name) : number(a) - number(b));
    groups.sort((a, b) => (down ? order(b, a) : order(a, b)));
    table.append(...groups);
    for (const head of heads) {
      const button = head.querySelector("button");
      if (button) head.setAttribute("aria-sort", button.dataset.key === name ? (down ? "descending" : "ascending") : "none");
    }
    key.value = name;
  };
  for (const head of heads) {
    const button = head.querySelector("button");
    if (button) button.addEventListener("click", () => sort(button.dataset.key, head.getAttribute("aria-sort") === "ascending"));
  }
  key.addEventListener("change", () => sort(key.value, !["name", "order"].includes(key.value)));
  for (const input of [text, verdict, passed]) input.addEventListener("input", filter);
  form.addEventListener("submit", (event) => event.preventDefault());
  passed.checked = groups.every((group) => group.dataset.verdict === "passed");
  form.hidden = said.hidden = false;
  filter();
}
</script>
)";

/// The class of the page, and the word for the verdict of an asset.
struct Badge {
    const char* kind;
    const char* word;
};
Badge badge_of(const Outcome& out) {
    if (out.verdict != Outcome::Verdict::ok)
        return {out.verdict == Outcome::Verdict::failed ? "bad" : "warn", verdict_word(out.verdict)};
    return out.warnings.empty() ? Badge{"good", "passed"} : Badge{"warn", "warnings"};
}

/// A number that sorts, and its text; empty without a value.
struct Amount {
    std::optional<std::uint64_t> sum;
    void add(const std::optional<std::uint64_t>& one) {
        if (one) sum = sum.value_or(0) + *one;
    }
    std::string key() const { return sum ? std::to_string(*sum) : ""; }
};

struct Amounts {
    Amount bytes, faces, calls, pixels;
    explicit Amounts(const Outcome& out) {
        for (const OutcomeFile& file : out.files) {
            bytes.add(file.bytes);
            faces.add(file.faces);
            calls.add(file.draw_calls);
            pixels.add(file.pixels);
        }
        if (!faces.sum && out.figures.faces_out > 0) faces.sum = out.figures.faces_out;
    }
};

std::string count_cell(const char* head, const std::optional<std::uint64_t>& count) {
    return fmt::format("<td class=\"number\" data-head=\"{}\">{}</td>", head, count ? grouped(*count) : "");
}

std::string file_cells(const Summary& summary, const std::string& path, const OutcomeFile& file) {
    const std::string name = std::filesystem::path(file.path).filename().generic_string();
    return fmt::format(
        "<td class=\"file\"><a href=\"{}\">{}</a></td><td class=\"number\" data-head=\"size\">{}"
        "</td>{}{}{}",
        escaped(link_to(summary, path, file.path)), escaped_path(name), sized(file.bytes),
        count_cell("triangles", file.faces), count_cell("draw calls", file.draw_calls),
        count_cell("pixels", file.pixels));
}

/// A message without the asset's name, which its row has.
std::string message_html(const Asset& asset, const Diagnostic& d, const char* kind) {
    const std::string name = asset.name + ": ";
    const std::string message = d.message.starts_with(name) ? d.message.substr(name.size()) : d.message;
    return fmt::format("<div class=\"{}\">{}: {}</div>", kind, escaped(d.id), escaped(message));
}

/// The messages of an asset: the errors, and the warnings folded.
std::string notes_of(const Asset& asset, const Outcome& out) {
    constexpr std::size_t most = 3; // errors that are not folded
    std::string html, folded;
    if (!out.customer.empty()) html += fmt::format("<p>{}</p>", escaped(out.customer));
    for (std::size_t i = 0; i < out.errors.size(); ++i)
        (i < most ? html : folded) += message_html(asset, out.errors[i], "bad");
    for (const auto& warning : out.warnings) folded += message_html(asset, warning, "warn");
    if (const std::string measures = measures_text(out.figures); !measures.empty())
        html += fmt::format("<div class=\"soft\">{}</div>", escaped(measures));
    if (folded.empty()) return html;
    std::vector<std::string> counts;
    if (out.errors.size() > most) counts.push_back(fmt::format("{} more errors", out.errors.size() - most));
    if (!out.warnings.empty()) counts.push_back(counted(out.warnings.size(), "warning"));
    return html +
           fmt::format("<details><summary>{}</summary>{}</details>", join_texts(counts, " and "), folded);
}

/// The text that the search field looks in.
std::string search_text(const Asset& asset, const Outcome& out) {
    std::string text = asset.name;
    for (const auto& file : out.files) text += " " + file.path;
    for (const auto* all : {&out.errors, &out.warnings})
        for (const auto& d : *all) text += " " + d.id;
    return lower_case(std::move(text));
}

/// The rows of the assets. Pictures are embedded until the page would become too large for a browser to open
/// quickly.
class AssetGroups {
  public:
    AssetGroups(const Summary& summary, const std::string& path) : summary_(summary), path_(path) {}

    std::string group(std::size_t i, std::size_t order) {
        const Asset& asset = summary_.assets[i];
        const Outcome& out = summary_.outcomes[i];
        const Badge badge = badge_of(out);
        const Amounts sum(out);
        std::string html = fmt::format(
            "<tbody data-verdict=\"{}\" data-name=\"{}\" data-text=\"{}\" data-order=\"{}\" data-size=\"{}\" "
            "data-triangles=\"{}\" data-calls=\"{}\" data-pixels=\"{}\" data-deviation=\"{}\">\n<tr>",
            badge.word, escaped(asset.name), escaped(search_text(asset, out)), order, sum.bytes.key(),
            sum.faces.key(), sum.calls.key(), sum.pixels.key(),
            out.deviation ? fmt::format("{}", *out.deviation) : "");
        const std::size_t rows = std::max<std::size_t>(1, out.files.size());
        html += fmt::format("<td class=\"picture\" rowspan=\"{}\">{}</td>", rows, picture(asset, out));
        html += fmt::format("<th scope=\"row\" rowspan=\"{}\">{}<br><span class=\"badge {}\">{}</span></th>",
                            rows, name_html(asset, out), badge.kind, badge.word);
        html += out.files.empty() ? "<td class=\"file\"></td><td></td>" +
                                        count_cell("triangles", sum.faces.sum) + "<td></td><td></td>"
                                  : file_cells(summary_, path_, out.files[0]);
        html += fmt::format("<td class=\"number\" data-head=\"deviation\" rowspan=\"{}\">{}</td></tr>\n",
                            rows, out.deviation ? percentage(*out.deviation) : "");
        for (std::size_t f = 1; f < out.files.size(); ++f)
            html += fmt::format("<tr>{}</tr>\n", file_cells(summary_, path_, out.files[f]));
        if (const std::string notes = notes_of(asset, out); !notes.empty())
            html += fmt::format("<tr><td></td><td class=\"notes\" colspan=\"7\">{}</td></tr>\n", notes);
        return html + "</tbody>\n";
    }

  private:
    std::string picture(const Asset& asset, const Outcome& out) {
        constexpr std::size_t most = 32 << 20;
        if (out.picture.empty() || bytes_ + out.picture.size() > most) return {};
        bytes_ += out.picture.size();
        return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", escaped(asset.name),
                           out.picture);
    }
    std::string name_html(const Asset& asset, const Outcome& out) const {
        if (out.reports.empty()) return escaped_path(asset.name);
        const auto page = std::find_if(out.reports.begin(), out.reports.end(),
                                       [](const std::string& report) { return report.ends_with(".html"); });
        return fmt::format(
            "<a href=\"{}\">{}</a>",
            escaped(link_to(summary_, path_, page != out.reports.end() ? *page : out.reports[0])),
            escaped_path(asset.name));
    }

    const Summary& summary_;
    const std::string& path_;
    std::size_t bytes_ = 0;
};

constexpr std::pair<const char*, const char*> sort_keys[] = {
    {"name", "asset"},       {"size", "size"},     {"triangles", "triangles"},
    {"calls", "draw calls"}, {"pixels", "pixels"}, {"deviation", "deviation"}};

std::string head_html() {
    std::string html = "<thead><tr><td></td>";
    for (const auto& [key, title] : sort_keys) {
        const bool is_name = std::string_view(key) == "name";
        html += fmt::format(
            "<th scope=\"col\"{} aria-sort=\"none\"><button type=\"button\" data-key=\"{}\">{}</button>"
            "</th>",
            is_name ? "" : " class=\"number\"", key, title);
        if (is_name) html += "<th scope=\"col\">file</th>";
    }
    return html + "</tr></thead>\n";
}

std::string form_html(const Summary& summary) {
    std::string verdicts = "<option value=\"\">all</option>";
    for (const char* word : {"failed", "interrupted", "not run", "warnings", "passed"}) {
        const auto n =
            std::count_if(summary.outcomes.begin(), summary.outcomes.end(),
                          [&](const Outcome& out) { return std::string_view(badge_of(out).word) == word; });
        if (n > 0) verdicts += fmt::format("<option value=\"{0}\">{0} ({1})</option>", word, n);
    }
    std::string keys = "<option value=\"order\">worst first</option>";
    for (const auto& [key, title] : sort_keys)
        keys += fmt::format("<option value=\"{}\">{}</option>", key, title);
    return fmt::format(
        "<form class=\"find\" role=\"search\" hidden>\n<label>Find<input type=\"search\" name=\"text\">"
        "</label>\n<label>Show<select name=\"verdict\">{}</select></label>\n<label>Sort by<select "
        "name=\"key\">{}</select></label>\n<label><input type=\"checkbox\" name=\"passed\"> with passed "
        "assets</label>\n</form>\n<p class=\"soft\" id=\"shown\" role=\"status\" hidden></p>\n",
        verdicts, keys);
}

std::string causes_html(const Summary& summary) {
    std::string rows;
    for (const Cause& cause : causes_of(summary))
        rows += fmt::format(
            "<tr>{}{}{}<td class=\"said\">{}</td></tr>\n",
            cell(fmt::format("<span class=\"{}\">{}</span>",
                             cause.severity == Severity::error ? "bad" : "warn", escaped(name_of(cause)))),
            number_cell(grouped(cause.assets)), cell(report::path_code(cause.first_asset)),
            escaped(cause.first_message));
    return report::table("Causes", report::heads({"cause", "#assets", "first asset", "its message"}), rows);
}

} // namespace

std::string to_html(const Summary& summary, const std::string& path) {
    constexpr std::size_t most_by_cause = 200;
    const bool good = count(summary, Outcome::Verdict::ok) == summary.assets.size();
    std::string page = report::html_begin(
        title_of(summary),
        fmt::format("{}, pipeline {}", counted(summary.assets.size(), "asset"), summary.pipeline));
    page += fmt::format("<p class=\"verdict {}\">{}</p>\n", good ? "good" : "bad", verdict_line(summary));
    if (summary.assets.empty()) return page + causes_html(summary) + report::html_end();
    auto order = worst_first(summary);
    const std::size_t left_out =
        summary.by_cause && order.size() > most_by_cause ? order.size() - most_by_cause : 0;
    order.resize(order.size() - left_out);
    page += style + fmt::format("<h2>Assets</h2>\n{}<div class=\"scroll\" tabindex=\"0\" role=\"group\" "
                                "aria-label=\"Assets\"><table class=\"assets\">\n{}",
                                form_html(summary), head_html());
    AssetGroups groups(summary, path);
    for (std::size_t i = 0; i < order.size(); ++i) page += groups.group(order[i], i);
    page += "</table></div>\n";
    if (left_out > 0)
        page += fmt::format("<p class=\"soft\">{} more assets are left out.</p>\n", grouped(left_out));
    return page + causes_html(summary) + script + report::html_end();
}

} // namespace facetmill::batch
