#include "report/html_parts.hpp"

#include "base/markup.hpp"

#include <fmt/format.h>

namespace facetmill::report {

namespace {

constexpr const char* style = R"(
:root { color-scheme: light dark; --line: #8884; --good: #2a7d3f; --bad: #c0362c; --warn: #a86400; --soft: #8882; }
@media (prefers-color-scheme: dark) { :root { --good: #6fca86; --bad: #ff8a80; --warn: #f0b45a; } }
body { font: 15px/1.5 system-ui, sans-serif; max-width: 68rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.5rem; margin-bottom: .2rem; overflow-wrap: break-word; } h2 { font-size: 1.1rem; margin: 2rem 0 .5rem; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; padding: .3rem .8rem .3rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; }
code { font-family: ui-monospace, monospace; font-size: .9em; overflow-wrap: break-word; }
.good { color: var(--good); } .bad { color: var(--bad); } .warn { color: var(--warn); } .soft { opacity: .7; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(15rem, 100%), 1fr)); gap: .8rem; }
.wide { grid-column: 1 / -1; }
figure { margin: 0; background: var(--soft); border-radius: .4rem; } img { display: block; width: 100%; height: auto; }
figcaption { padding: .3rem .7rem .5rem; font-size: .9em; }
td:first-child span { white-space: nowrap; }
.verdict { font-weight: 600; padding: .6rem 1rem; background: var(--soft); border-radius: .4rem; }
)";

} // namespace

std::string code(const std::string& text) { return fmt::format("<code>{}</code>", escaped(text)); }
std::string cell(const std::string& html) { return fmt::format("<td>{}</td>", html); }
std::string number_cell(const std::string& html) { return fmt::format("<td class=\"number\">{}</td>", html); }

std::string table(const std::string& title, const std::string& header, const std::string& rows) {
    if (rows.empty()) return {};
    return fmt::format("<h2>{}</h2>\n<div class=\"scroll\"><table>\n<tr>{}</tr>\n{}</table></div>\n", title,
                       header, rows);
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
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
        "content=\"width=device-width, "
        "initial-scale=1\">\n<title>{0}: facetmill "
        "report</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n<p class=\"soft\">{2}</p>\n",
        escaped(title), style, escaped(about));
}

std::string html_end() {
    return fmt::format("<p class=\"soft\">facetmill {}</p>\n</body>\n</html>\n", FACETMILL_VERSION);
}

} // namespace facetmill::report
