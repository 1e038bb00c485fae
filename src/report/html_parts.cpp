#include "report/html_parts.hpp"

#include "base/text/markup.hpp"
#include "facetmill_version.hpp"

#include <fmt/format.h>

namespace facetmill::report {

namespace {

constexpr const char* style = R"(
:root { color-scheme: light dark; --ink: #1d2228; --paper: #fff; --soft: #f3f4f6; --line: #dfe2e6; --quiet: #5a6370;
  --good: #1f6b33; --bad: #a82a20; --warn: #855000; --accent: #2b5fb4; --bar: #7d9fd0; --before: #99420c; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e7eb; --paper: #15181c; --soft: #20242a; --line: #363c44;
  --quiet: #a3adb9; --good: #6fca86; --bad: #ff8a80; --warn: #f0b45a; --accent: #8ab4f8; --bar: #55779f; --before: #f2a66b; } }
html { background: var(--paper); color: var(--ink); -webkit-text-size-adjust: 100%; }
body { font: 15px/1.55 system-ui, -apple-system, "Segoe UI", Roboto, sans-serif; max-width: 72rem; margin: 0 auto;
  padding: 2.2rem 1.25rem 4rem; overflow-wrap: break-word; }
h1 { font-size: 1.6rem; line-height: 1.25; margin: 0 0 .25rem; } h2 { font-size: 1.15rem; margin: 2.3rem 0 .6rem; }
h3 { font-size: 1rem; margin: 0 0 .3rem; } h4 { font-size: .85rem; margin: .9rem 0 .3rem; color: var(--quiet); }
h1, h2, h3, h4 { overflow-wrap: break-word; text-wrap: balance; } p { margin: .35rem 0; } a { color: var(--accent); }
.scroll { overflow-x: auto; } :focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; }
table { border-collapse: collapse; min-width: 100%; font-size: .93rem; }
th, td { text-align: left; padding: .38rem 1.1rem .38rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
tr > :last-child { padding-right: 0; } th { font-weight: 600; } tr > th[scope=row] { font-weight: 400; color: var(--quiet);
  white-space: nowrap; width: 10rem; } td.number, th.number { text-align: right; font-variant-numeric: tabular-nums;
  white-space: nowrap; } tr.sum td { font-weight: 600; }
code, pre { font-family: ui-monospace, SFMono-Regular, Menlo, Consolas, monospace; font-size: .88em; }
pre { background: var(--soft); border-radius: .4rem; padding: .7rem .9rem; overflow-x: auto; margin: .3rem 0; }
.good { color: var(--good); } .bad { color: var(--bad); } .warn { color: var(--warn); } .soft { color: var(--quiet); }
p.soft { font-size: .88rem; max-width: 46rem; } td:first-child span { white-space: nowrap; }
td.notes { min-width: 22rem; } .digest code { overflow-wrap: anywhere; display: inline-block; min-width: 18em; font-size: .78em; }
.badge { font-size: .82rem; font-weight: 600; border: 1px solid; border-radius: 1rem; padding: .02rem .55rem; }
.verdict { font-weight: 600; padding: .75rem 1.1rem; background: var(--soft); border-left: .3rem solid;
  border-radius: .3rem; margin: 1.1rem 0 .4rem; }
.stage, .check { border-top: 1px solid var(--line); padding: 1rem 0; } .stage { display: grid; gap: 0 2rem; }
section.check { color: inherit; } .check.bad { border-top-color: var(--bad); } .stage > * { min-width: 0; } .stage > .wide { grid-column: 1 / -1; } .stage p { margin: .1rem 0; }
figure { margin: .6rem 0; max-width: 30rem; background: var(--soft); border-radius: .5rem; overflow: hidden; }
figure.wide { max-width: 60rem; } figcaption { padding: .45rem .8rem .55rem; font-size: .85rem; color: var(--quiet); }
img { display: block; width: 100%; height: auto; } .layers { display: grid; } .layers img { grid-area: 1 / 1; }
figure.compared [data-of] { clip-path: inset(0 calc(100% - var(--at)) 0 0); }
figure.compared [id] { clip-path: inset(0 0 0 var(--at)); } [hidden] { display: none !important; }
input[type=range] { width: calc(100% - 1.6rem); margin: .3rem .8rem; accent-color: var(--accent); }
details { margin: .3rem 0; } summary { cursor: pointer; font-size: .88rem; color: var(--quiet); }
dl { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: .25rem 1.2rem; margin: .4rem 0; }
dt { color: var(--quiet); } dd { margin: 0; } dl.ranges { font-size: .85rem; } dd pre { margin: 0; }
svg.chart { display: block; width: 100%; height: auto; max-width: 40rem; } .chart text { font-size: 12px; fill: var(--quiet); }
.chart .bar { fill: var(--bar); } .chart .axis { stroke: var(--line); fill: none; }
.chart .before { stroke: var(--before); stroke-width: 1.5; fill: none; }
.charts { display: grid; gap: 1rem 2rem; grid-template-columns: repeat(auto-fit, minmax(min(100%, 18rem), 1fr)); }
.deviation { display: grid; gap: 0 1.5rem; grid-template-columns: repeat(auto-fit, minmax(min(100%, 19rem), 1fr)); }
.deviation figure { max-width: none; } .deviation + h3 { margin-top: 1.6rem; } .deviation .wide { grid-column: 1 / -1; } .card { min-width: 0; }
td.share { width: 22%; min-width: 5rem; } td.share span { display: block; height: .75rem; margin-top: .35rem;
  border-radius: .2rem; background: var(--bar); min-width: 1px; }
@media (min-width: 800px) { .stage.pictured { grid-template-columns: minmax(0, 26rem) minmax(0, 1fr); }
  .stage.pictured > .shown { grid-column: 1; } .stage.pictured > .told { grid-column: 2; } }
@media (max-width: 480px) { body { padding: 1.2rem 1rem 3rem; } dl { grid-template-columns: minmax(0, 1fr); gap: 0; }
  th, td { padding-right: .7rem; } dd { margin-bottom: .5rem; } tr > th[scope=row] { white-space: normal; width: auto; } td.said { min-width: 15rem; } }
@media (max-width: 640px) { table.cards, .cards tbody, .cards tr { display: block; }
  .cards tr { border-bottom: 1px solid var(--line); padding: .45rem 0; } .cards tr:first-child { display: none; }
  .cards td, .cards td.number { display: block; border: 0; padding: .12rem 0 .12rem 7.5rem; position: relative;
    text-align: left; white-space: normal; min-width: 0; width: auto; overflow-wrap: break-word; }
  .cards td::before { content: attr(data-head); position: absolute; left: 0; width: 7rem; color: var(--quiet);
    font-weight: 400; } .cards td:empty { display: none; } .digest code { min-width: 0; }
  td:last-child { overflow-wrap: anywhere; } td.number { white-space: normal; overflow-wrap: break-word; } }
@media print { body { max-width: none; padding: 0; } details { display: none; } .scroll { overflow: visible; } }
)";

/// Shows the previous picture below a stage's own picture, to the left of the slider. Tables that do not fit
/// on a phone (table.cards) show each cell with its heading. Without scripts, the page has no sliders, and
/// such tables scroll.
constexpr const char* script = R"(
for (const input of document.querySelectorAll("figure input")) {
  const figure = input.closest("figure"), before = figure.querySelector("[data-of]");
  const move = () => figure.style.setProperty("--at", input.value + "%");
  before.src = document.getElementById(before.dataset.of).src;
  before.hidden = input.hidden = false;
  figure.classList.add("compared");
  input.addEventListener("input", move);
  move();
}
for (const table of document.querySelectorAll("table")) {
  const heads = [...table.rows[0].cells].map((cell) => cell.textContent);
  if (heads.length < 4 || table.querySelector("th[scope=row]")) continue;
  table.classList.add("cards");
  for (const row of [...table.rows].slice(1))
    [...row.cells].forEach((cell, i) => { if (heads[i]) cell.dataset.head = heads[i]; });
}
)";

} // namespace

std::string code(const std::string& text) { return fmt::format("<code>{}</code>", escaped(text)); }
std::string path_code(const std::string& path) { return fmt::format("<code>{}</code>", escaped_path(path)); }
std::string cell(const std::string& html) { return fmt::format("<td>{}</td>", html); }
std::string number_cell(const std::string& html) { return fmt::format("<td class=\"number\">{}</td>", html); }

namespace {
std::string titled_table(const char* level, const std::string& title, const std::string& header,
                         const std::string& rows) {
    if (rows.empty()) return {};
    return fmt::format(
        "<{0}>{1}</{0}>\n<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"{1}\">"
        "<table>\n{2}{3}</table></div>\n",
        level, escaped(title), header.empty() ? "" : fmt::format("<tr>{}</tr>\n", header), rows);
}
} // namespace

std::string table(const std::string& title, const std::string& header, const std::string& rows) {
    return titled_table("h2", title, header, rows);
}
std::string subtable(const std::string& title, const std::string& header, const std::string& rows,
                     const char* level) {
    return titled_table(level, title, header, rows);
}

std::string picture(const std::string& id, const std::string& alt, const std::string& png) {
    return fmt::format("<img alt=\"{}\" id=\"{}\" src=\"data:image/png;base64,{}\">", escaped(alt), id, png);
}

namespace {
std::string framed(const std::string& inside, const std::string& caption, bool wide) {
    return fmt::format("<figure{}>{}<figcaption>{}</figcaption></figure>\n", wide ? " class=\"wide\"" : "",
                       inside, escaped(caption));
}
} // namespace

std::string figure(const std::string& picture, const std::string& caption, bool wide) {
    return framed(fmt::format("<div class=\"layers\">{}</div>", picture), caption, wide);
}

std::string compared_figure(const std::string& picture, const std::string& before_id, const std::string& name,
                            const std::string& caption) {
    return framed(
        fmt::format("<div class=\"layers\"><img alt=\"{0}: before\" data-of=\"{1}\" hidden>{2}</div>"
                    "<input type=\"range\" min=\"0\" max=\"100\" value=\"50\" hidden "
                    "aria-label=\"{0}: before on the left, after on the right\">",
                    escaped(name), before_id, picture),
        caption, false);
}

std::string not_drawn_html(const std::vector<Diagnostic>& not_drawn) {
    std::string out;
    for (const Diagnostic& d : not_drawn)
        out += fmt::format("<p class=\"warn\">{}: {}; {}</p>\n", path_code(to_string(d.where)),
                           escaped(d.message), escaped(d.hint));
    return out;
}

std::string heads(std::initializer_list<const char*> titles) {
    std::string out;
    for (const std::string title : titles)                         // a leading # marks a column of numbers
        out += title.empty()            ? std::string("<td></td>") // no text, so not a heading
               : title.starts_with('#') ? fmt::format("<th class=\"number\">{}</th>", title.substr(1))
                                        : fmt::format("<th>{}</th>", title);
    return out;
}

std::string html_begin(const std::string& title, const std::string& about, const std::string& whole) {
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
        "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n<meta name=\"viewport\" "
        "content=\"width=device-width, "
        "initial-scale=1\">\n<title>{0}: facetmill "
        "report</title>\n<style>{1}</style>\n</head>\n<body>\n<main>\n<h1{3}>{4}</h1>\n<p "
        "class=\"soft\">{2}</p>\n",
        escaped(title), style, escaped(about),
        whole.empty() || whole == title ? "" : fmt::format(" title=\"{}\"", escaped(whole)),
        escaped_path(title));
}

std::string html_end() {
    return fmt::format("<p class=\"soft\">facetmill {}</p>\n</main>\n<script>{}</script>\n</body>\n</html>\n",
                       FACETMILL_VERSION, script);
}

} // namespace facetmill::report
