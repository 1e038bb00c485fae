#include "report/html_parts.hpp"

#include "base/markup.hpp"

#include <fmt/format.h>

namespace facetmill::report {

namespace {

constexpr const char* style = R"(
:root { color-scheme: light dark; --line: #8884; --good: #1f6b33; --bad: #a82a20; --warn: #8a5200; --soft: #8882; }
@media (prefers-color-scheme: dark) { :root { --good: #6fca86; --bad: #ff8a80; --warn: #f0b45a; } }
html { background: Canvas; color: CanvasText; }
body { font: 15px/1.5 system-ui, sans-serif; max-width: 68rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.5rem; margin-bottom: .2rem; overflow-wrap: break-word; } h2 { font-size: 1.1rem; margin: 2rem 0 .5rem; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; padding: .3rem .8rem .3rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; }
code { font-family: ui-monospace, monospace; font-size: .9em; overflow-wrap: break-word; }
.good { color: var(--good); } .bad { color: var(--bad); } .warn { color: var(--warn); } .soft { opacity: .8; }
h3 { font-size: 1rem; margin: 0 0 .2rem; overflow-wrap: break-word; } h4 { font-size: .9rem; margin: .8rem 0 .2rem; }
.stage { border-left: 3px solid var(--line); padding-left: .8rem; margin: 0 0 1.2rem; } .stage p { margin: .1rem 0; }
figure { margin: .5rem 0; max-width: 30rem; background: var(--soft); border-radius: .4rem; } .wide { max-width: none; }
img { display: block; width: 100%; height: auto; } .layers { display: grid; } .layers img { grid-area: 1 / 1; }
figure.compared [data-of] { clip-path: inset(0 calc(100% - var(--at)) 0 0); }
figure.compared [id] { clip-path: inset(0 0 0 var(--at)); }
input[type=range] { width: calc(100% - 1.4rem); margin: .2rem .7rem; } [hidden] { display: none !important; }
figcaption { padding: .3rem .7rem .5rem; font-size: .9em; } summary { cursor: pointer; font-size: .9em; }
td:first-child span { white-space: nowrap; }
.verdict { font-weight: 600; padding: .6rem 1rem; background: var(--soft); border-radius: .4rem; }
)";

/// Shows the picture before beneath a stage's own, left of the slider; without scripts the page has no
/// sliders.
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
)";

} // namespace

std::string code(const std::string& text) { return fmt::format("<code>{}</code>", escaped(text)); }
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
std::string subtable(const std::string& title, const std::string& header, const std::string& rows) {
    return titled_table("h4", title, header, rows);
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

std::string heads(std::initializer_list<const char*> titles) {
    std::string out;
    for (const std::string title : titles) // a leading # marks a column of numbers
        out += title.starts_with('#') ? fmt::format("<th class=\"number\">{}</th>", title.substr(1))
                                      : fmt::format("<th>{}</th>", title);
    return out;
}

std::string html_begin(const std::string& title, const std::string& about) {
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
        "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n<meta name=\"viewport\" "
        "content=\"width=device-width, "
        "initial-scale=1\">\n<title>{0}: facetmill "
        "report</title>\n<style>{1}</style>\n</head>\n<body>\n<main>\n<h1>{0}</h1>\n<p "
        "class=\"soft\">{2}</p>\n",
        escaped(title), style, escaped(about));
}

std::string html_end() {
    return fmt::format("<p class=\"soft\">facetmill {}</p>\n</main>\n<script>{}</script>\n</body>\n</html>\n",
                       FACETMILL_VERSION, script);
}

} // namespace facetmill::report
