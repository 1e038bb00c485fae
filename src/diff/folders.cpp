#include "diff/folders.hpp"

#include "base/text/markup.hpp"
#include "base/text/percent_encoded.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/short_names.hpp"
#include "base/text/words.hpp"
#include "diff/overview.hpp"
#include "facetmill_version.hpp"
#include "io/codec.hpp"
#include "report/html_parts.hpp"
#include "report/markdown_parts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace facetmill::report {

namespace fs = std::filesystem;
using FolderOutcome = FolderPair::Outcome;

namespace {

std::set<std::string> meshes_in(const fs::path& folder) {
    std::set<std::string> paths;
    std::error_code error;
    fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error);
    for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
        std::error_code unknown;
        if (!at->is_regular_file(unknown)) continue;
        const auto* codec = io::codec_for(at->path());
        if (codec && codec->read) paths.insert(at->path().lexically_relative(folder).generic_string());
    }
    if (error)
        throw Error(ErrorKind::missing, "E-FILE",
                    fmt::format("cannot read the folder '{}': {}", folder.generic_string(), error.message()),
                    "check its permissions");
    return paths;
}

/// Files of either folder without a counterpart of the same path, whose names differ only by suffix.
struct Namesakes {
    std::vector<std::string> a, b;
};

/// "a.obj, a.ply".
std::string listed(const std::vector<std::string>& paths) {
    std::string text;
    for (const auto& path : paths) append_item(text, path);
    return text;
}

void add_namesakes(const Namesakes& n, std::vector<PairedPaths>& pairs) {
    if (n.a.size() == 1 && n.b.size() == 1) {
        pairs.push_back({n.a.front(), n.b.front()});
        return;
    }
    const auto why = [&](const std::vector<std::string>& others, const char* folder) {
        return others.empty()
                   ? std::string()
                   : fmt::format("not paired, because several files share this name: the {} folder has {}",
                                 folder, listed(others));
    };
    for (const auto& path : n.a) pairs.push_back({path, {}, why(n.b, "second")});
    for (const auto& path : n.b) pairs.push_back({{}, path, why(n.a, "first")});
}

std::string tally(const FolderComparison& c) {
    std::string text;
    for (const auto outcome : {FolderOutcome::failed, FolderOutcome::differs, FolderOutcome::removed,
                               FolderOutcome::added, FolderOutcome::same}) {
        const auto count = std::count_if(c.pairs.begin(), c.pairs.end(),
                                         [&](const FolderPair& p) { return p.outcome == outcome; });
        if (count > 0)
            append_item(text,
                        fmt::format("{} {}", grouped(static_cast<std::uint64_t>(count)), to_string(outcome)));
    }
    return text.empty() ? "no mesh files" : text;
}

std::string percent_text(const FolderPair& pair) {
    if (!pair.percent) return {};
    return std::isfinite(*pair.percent) ? percentage(*pair.percent) : "not comparable";
}

const char* kind_of_pair(const FolderPair& pair) {
    if (pair.outcome == FolderOutcome::same) return "good";
    return pair.outcome == FolderOutcome::added ? "warn" : "bad";
}

/// The change is unknown if the pair failed.
std::string change_text(const FolderPair& pair, std::uint64_t a, std::uint64_t b,
                        std::string (*tell)(std::uint64_t)) {
    if (pair.outcome == FolderOutcome::failed) return {};
    return a == b ? tell(a) : fmt::format("{} → {}", a > 0 ? tell(a) : "-", b > 0 ? tell(b) : "-");
}

/// Embeds small pictures until the page would become too large for a browser to open quickly.
std::string picture_cells(const FolderPair& pair, std::size_t& bytes) {
    constexpr std::size_t most = 2'500'000;
    std::string cells;
    for (const auto* picture : {&pair.picture_a, &pair.picture_b}) {
        const bool fits = !picture->empty() && bytes + picture->size() <= most;
        if (fits) bytes += picture->size();
        cells += cell(
            fits ? fmt::format("<img alt=\"{}: {}\" style=\"width:7rem\" src=\"data:image/png;base64,{}\">",
                               escaped(pair.paths.text()), picture == &pair.picture_a ? "first" : "second",
                               *picture)
                 : "");
    }
    return cells;
}

std::string name_html(const FolderPair& pair) {
    if (pair.page.empty()) return path_code(pair.paths.text());
    return fmt::format("<a href=\"{}\">{}</a>", percent_encoded(pair.page), path_code(pair.paths.text()));
}

/// "counts, geometry", or the reason why there is no comparison.
std::string more_of(const FolderPair& pair) {
    if (pair.outcome == FolderOutcome::failed) return pair.verdict;
    return pair.paths.unpaired.empty() ? pair.differs_in : pair.paths.unpaired;
}

Json path_json(const std::string& path) { return path.empty() ? Json(nullptr) : Json(path); }

std::vector<Diagnostic> not_drawn_in(const FolderComparison& c) {
    std::vector<Diagnostic> all;
    for (const FolderPair& pair : c.pairs)
        all.insert(all.end(), pair.not_drawn.begin(), pair.not_drawn.end());
    return all;
}

} // namespace

const char* to_string(FolderOutcome outcome) {
    switch (outcome) {
    case FolderOutcome::failed:
        return "failed";
    case FolderOutcome::differs:
        return "differs";
    case FolderOutcome::removed:
        return "removed";
    case FolderOutcome::added:
        return "added";
    case FolderOutcome::same:
        break;
    }
    return "same";
}

bool FolderComparison::differs() const {
    return std::any_of(pairs.begin(), pairs.end(),
                       [](const FolderPair& p) { return p.outcome != FolderOutcome::same; });
}

std::string PairedPaths::text() const {
    if (a.empty() || b.empty() || a == b) return path();
    return fmt::format("{} and {}", a, fs::path(b).filename().generic_string());
}

std::vector<PairedPaths> pairs_in(const fs::path& a, const fs::path& b) {
    const auto in_a = meshes_in(a), in_b = meshes_in(b);
    std::vector<PairedPaths> pairs;
    std::map<std::string, Namesakes> rest; // the other files, by path without suffix
    const auto stem = [](const std::string& path) {
        return fs::path(path).replace_extension().generic_string();
    };
    for (const auto& path : in_a)
        if (in_b.contains(path))
            pairs.push_back({path, path});
        else
            rest[stem(path)].a.push_back(path);
    for (const auto& path : in_b)
        if (!in_a.contains(path)) rest[stem(path)].b.push_back(path);
    for (const auto& [_, namesakes] : rest) add_namesakes(namesakes, pairs);
    std::sort(pairs.begin(), pairs.end(),
              [](const PairedPaths& x, const PairedPaths& y) { return x.path() < y.path(); });
    return pairs;
}

void tell(const Comparison& comparison, FolderPair& pair) {
    pair.outcome = comparison.differs() ? FolderOutcome::differs : FolderOutcome::same;
    pair.verdict = verdict_of(comparison);
    pair.faces_a = static_cast<std::uint64_t>(comparison.properties_a.faces);
    pair.faces_b = static_cast<std::uint64_t>(comparison.properties_b.faces);
    if (comparison.size_a) pair.bytes_a = comparison.size_a->bytes;
    if (comparison.size_b) pair.bytes_b = comparison.size_b->bytes;
    if (comparison.deviation) pair.percent = comparison.deviation->percent(comparison.deviation->maximum());
    pair.differs_in = differs_in(comparison);
}

std::vector<std::size_t> worst_first(const FolderComparison& comparison) {
    std::vector<std::size_t> order(comparison.pairs.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto far = [&](std::size_t i) {
        const double percent = comparison.pairs[i].percent.value_or(0);
        return std::isnan(percent) ? HUGE_VAL : percent; // a missing number is worse than any other
    };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) {
        const auto x = comparison.pairs[i].outcome, y = comparison.pairs[k].outcome;
        return x != y ? x < y : far(i) > far(k);
    });
    return order;
}

std::string to_text(const FolderComparison& c, const std::string& name_a, const std::string& name_b,
                    bool all) {
    std::string text =
        fmt::format("{} and {} {}: {}\n", name_a, name_b, c.differs() ? "differ" : "agree", tally(c));
    for (const std::size_t i : worst_first(c)) {
        const FolderPair& pair = c.pairs[i];
        if (pair.outcome == FolderOutcome::same && !all) continue;
        std::string more = more_of(pair);
        if (const std::string percent = percent_text(pair); !percent.empty())
            append_item(more, "deviation " + percent, "; ");
        text += fmt::format("  {:<8} {:<40} {}\n", to_string(pair.outcome), pair.paths.text(), more);
    }
    return text;
}

Json to_json(const FolderComparison& c, const std::string& name_a, const std::string& name_b) {
    Json files = Json::array();
    for (const std::size_t i : worst_first(c)) {
        const FolderPair& p = c.pairs[i];
        files.push_back(
            {{"path", p.paths.path()},
             {"paths", {{"a", path_json(p.paths.a)}, {"b", path_json(p.paths.b)}}},
             {"outcome", to_string(p.outcome)},
             {"exit_code", p.exit_code},
             {"verdict", p.verdict},
             {"differs_in", p.differs_in},
             {"deviation_percent", p.percent && std::isfinite(*p.percent) ? Json(*p.percent) : Json(nullptr)},
             {"faces", {{"a", p.faces_a}, {"b", p.faces_b}}},
             {"bytes", {{"a", p.bytes_a}, {"b", p.bytes_b}}},
             {"page", path_json(p.page)}});
    }
    return {{"a", name_a}, {"b", name_b}, {"same", !c.differs()}, {"files", std::move(files)}};
}

std::string to_html(const FolderComparison& c, const std::string& path_a, const std::string& path_b) {
    std::string rows;
    std::size_t bytes = 0;
    for (const std::size_t i : worst_first(c)) {
        const FolderPair& p = c.pairs[i];
        rows += fmt::format(
            "<tr>{}{}{}{}{}{}{}</tr>\n",
            cell(fmt::format("<span class=\"badge {}\">{}</span>", kind_of_pair(p), to_string(p.outcome))),
            cell(name_html(p)), picture_cells(p, bytes), number_cell(percent_text(p)),
            number_cell(change_text(p, p.faces_a, p.faces_b, grouped)),
            number_cell(change_text(p, p.bytes_a, p.bytes_b, sized)), cell(escaped(more_of(p))));
    }
    std::string out = comparison_begin(short_names(path_a, path_b), {path_a, path_b},
                                       "Compared by facetmill diff. The largest differences come first.");
    out += fmt::format("<p class=\"verdict {}\">{}: {}</p>\n", c.differs() ? "bad" : "good",
                       c.differs() ? "differ" : "agree", tally(c));
    return out +
           table(
               "Files",
               heads({"outcome", "file", "first", "second", "#deviation", "#faces", "#bytes", "differs in"}),
               rows) +
           not_drawn_html(not_drawn_in(c)) + html_end();
}

std::string to_markdown(const FolderComparison& c, const std::string& path_a, const std::string& path_b) {
    std::vector<std::vector<std::string>> rows;
    std::size_t same = 0;
    for (const std::size_t i : worst_first(c)) {
        const FolderPair& p = c.pairs[i];
        if (p.outcome == FolderOutcome::same) {
            ++same;
            continue;
        }
        // No links to the pages of pairs: in a comment of a pull request these files do not exist.
        rows.push_back({to_string(p.outcome), markdown_escaped(p.paths.text()), percent_text(p),
                        change_text(p, p.faces_a, p.faces_b, grouped),
                        change_text(p, p.bytes_a, p.bytes_b, sized), markdown_escaped(more_of(p))});
    }
    std::string out = comparison_heading(short_names(path_a, path_b), {path_a, path_b}) +
                      fmt::format("\n**{}: {}**\n", c.differs() ? "differ" : "agree", tally(c));
    out += markdown_table("Files", {"outcome", "file", "deviation", "faces", "bytes", "differs in"}, rows);
    if (same > 0) out += fmt::format("\n{} the same.\n", counted(same, "file is", "files are"));
    return out + fmt::format("\nfacetmill {}\n", FACETMILL_VERSION);
}

Json folder_comparison_schema() {
    const auto typed = [](const char* type) { return Json{{"type", type}}; };
    const auto closed = [](Json properties) {
        Json required = Json::array();
        for (const auto& [key, value] : properties.items()) required.push_back(key);
        return Json{{"type", "object"},
                    {"required", required},
                    {"additionalProperties", false},
                    {"properties", properties}};
    };
    const Json both = closed({{"a", typed("integer")}, {"b", typed("integer")}});
    const Json path = {{"type", {"string", "null"}}};
    const Json file = closed({{"path", typed("string")},
                              {"paths", closed({{"a", path}, {"b", path}})},
                              {"outcome", {{"enum", {"failed", "differs", "removed", "added", "same"}}}},
                              {"exit_code", typed("integer")},
                              {"verdict", typed("string")},
                              {"differs_in", typed("string")},
                              {"deviation_percent", {{"type", {"number", "null"}}}},
                              {"faces", both},
                              {"bytes", both},
                              {"page", path}});
    Json schema = closed({{"a", typed("string")},
                          {"b", typed("string")},
                          {"same", typed("boolean")},
                          {"files", {{"type", "array"}, {"items", file}}}});
    Json out = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                {"title", "facetmill diff of folders"}};
    out.update(schema);
    return out;
}

} // namespace facetmill::report
