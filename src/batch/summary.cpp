// The summary of a batch as text and JUnit.

#include "base/ordered_set.hpp"
#include "base/text/markup.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "batch/causes.hpp"
#include "batch/words.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <numeric>

namespace facetmill::batch {

namespace {

/// By severity, the worst last: problems of the asset, the machine, the pipeline, the program.
constexpr std::array by_gravity{0, 1, 3, 6, 5, 7, 4, 2, 70};

std::size_t gravity(int code) {
    return static_cast<std::size_t>(std::find(by_gravity.begin(), by_gravity.end(), code) -
                                    by_gravity.begin());
}

/// The group of an outcome in a summary.
std::size_t place_of(const Outcome& out) {
    const std::size_t codes = by_gravity.size();
    switch (out.verdict) {
    case Outcome::Verdict::failed:
        return codes - std::min(codes, gravity(out.exit_code));
    case Outcome::Verdict::interrupted:
        return codes + 1;
    case Outcome::Verdict::not_run:
        return codes + 2;
    case Outcome::Verdict::ok:
        break;
    }
    return out.warnings.empty() ? codes + 4 : codes + 3;
}

enum class BatchForm { report, terminal };

/// The ids of its errors, each once: "E-STRICT, E-EMPTY".
std::string ids_of(const std::vector<Diagnostic>& errors) {
    OrderedSet<std::string> ids;
    for (const auto& error : errors) ids.add(error.id);
    return fmt::format("{}", fmt::join(ids.all(), ", "));
}

/// Adds a line of the table, and in reports the errors below it.
void add_line(const Asset& asset, const Outcome& out, BatchForm form, Painted& text) {
    const bool terminal = form == BatchForm::terminal;
    const std::string word = terminal && out.kept ? "kept" : verdict_word(out.verdict);
    const bool bad = out.verdict == Outcome::Verdict::failed || out.verdict == Outcome::Verdict::interrupted;
    text += "  ";
    text.paint(bad ? "1;31" : "32", fmt::format("{:<11}", word)) += "  " + one_line(asset.name);
    if (out.verdict == Outcome::Verdict::failed) text += fmt::format("  exit code {}", out.exit_code);
    if (terminal && !out.errors.empty()) text += "  " + ids_of(out.errors);
    for (const Column& column : columns())
        if (out.verdict == Outcome::Verdict::ok && column.phrase)
            if (const std::string phrase = column.phrase(out.figures); !phrase.empty()) text += "  " + phrase;
    if (terminal && out.seconds > 0) text += fmt::format("  {}", timed(out.seconds));
    if (!out.warnings.empty()) text += "  " + counted(out.warnings.size(), "warning");
    text += "\n";
    if (terminal) return;
    for (const auto& error : out.errors)
        text += fmt::format("{:15}[{}] {}\n", "", error.id, one_line(error.message));
}

std::string totals(const Summary& summary, BatchForm form) {
    std::size_t kept = 0;
    for (const auto& out : summary.outcomes) kept += out.kept;
    std::string text = fmt::format("{}: {} ok", counted(summary.assets.size(), "asset"),
                                   count(summary, Outcome::Verdict::ok));
    if (form == BatchForm::terminal && kept > 0)
        text += fmt::format(" ({} kept from an earlier batch)", kept);
    for (const auto verdict :
         {Outcome::Verdict::failed, Outcome::Verdict::interrupted, Outcome::Verdict::not_run})
        if (const auto n = count(summary, verdict); n > 0)
            text += fmt::format(", {} {}", n, verdict_word(verdict));
    return text;
}

/// The most common causes, one line each, in at most this many lines.
void add_causes(const Summary& summary, std::size_t most, Painted& text) {
    const auto causes = causes_of(summary);
    const std::size_t shown = causes.size() <= most ? causes.size() : most - 1;
    for (std::size_t i = 0; i < shown; ++i) {
        const Cause& cause = causes[i];
        const bool error = cause.severity == Severity::error;
        text += "  ";
        text.paint(error ? "1;31" : "33", fmt::format("{:<8}", error ? "error" : "warning"));
        text += fmt::format("{:<28} {}", name_of(cause), counted(cause.assets, "asset"));
        if (!cause.first_asset.empty()) text += ", first " + one_line(cause.first_asset);
        text += "\n";
    }
    if (causes.size() > shown)
        text += fmt::format("  and {} more causes: --report F.json lists all\n", causes.size() - shown);
}

constexpr std::size_t most_causes = 9; // with the totals, ten lines

} // namespace

int worse_exit_code(int a, int b) { return gravity(a) < gravity(b) ? b : a; }

std::vector<std::size_t> worst_first(const Summary& summary) {
    std::vector<std::size_t> order(summary.assets.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return place_of(summary.outcomes[a]) < place_of(summary.outcomes[b]);
    });
    return order;
}

std::size_t count(const Summary& summary, Outcome::Verdict verdict) {
    return static_cast<std::size_t>(
        std::count_if(summary.outcomes.begin(), summary.outcomes.end(),
                      [&](const Outcome& out) { return out.verdict == verdict; }));
}

const char* verdict_word(Outcome::Verdict verdict) {
    constexpr const char* words[] = {"ok", "failed", "interrupted", "not run"};
    return words[static_cast<int>(verdict)];
}

std::string one_line(std::string_view text) {
    std::string out;
    for (const char c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
            out += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
        else
            out += c;
    return out;
}

Painted to_terminal(const Summary& summary, bool colour, bool all) {
    constexpr std::size_t most = 40; // successful assets
    const auto went_well = [&](std::size_t i) {
        const auto verdict = summary.outcomes[i].verdict;
        return verdict == Outcome::Verdict::ok || verdict == Outcome::Verdict::not_run;
    };
    const auto order = summary.by_cause ? std::vector<std::size_t>() : worst_first(summary);
    const auto good = static_cast<std::size_t>(std::count_if(order.begin(), order.end(), went_well));
    const std::size_t told = all || good <= most + 1 ? good : most;
    Painted text(colour);
    std::size_t seen = 0;
    for (const std::size_t i : order)
        if (!went_well(i) || ++seen <= told)
            add_line(summary.assets[i], summary.outcomes[i], BatchForm::terminal, text);
    if (summary.by_cause) add_causes(summary, most_causes, text);
    if (good > told) text += fmt::format("  ... and {} more (-v or --report lists all)\n", good - told);
    for (const auto& path : summary.pruned) text += fmt::format("removed {}\n", one_line(path));
    text += totals(summary, BatchForm::terminal);
    text += fmt::format("; {}, {} at a time", timed(summary.seconds), summary.jobs);
    return text += summary.exit_code != 0 ? fmt::format("; exit code {}\n", summary.exit_code) : "\n";
}

std::string to_text(const Summary& summary) {
    Painted text(false);
    text += summary.pipeline + "\n";
    for (const auto& error : summary.errors)
        text += fmt::format("  [{}] {}\n", error.id, one_line(error.message));
    add_causes(summary, most_causes, text);
    if (!summary.by_cause)
        for (const std::size_t i : worst_first(summary))
            add_line(summary.assets[i], summary.outcomes[i], BatchForm::report, text);
    text += fmt::format("{}; exit code {}\n", totals(summary, BatchForm::report), summary.exit_code);
    return text.text();
}

std::string timings_text(const Summary& summary) {
    Json assets = Json::array();
    for (std::size_t i = 0; i < summary.assets.size(); ++i)
        assets.push_back({{"asset", summary.assets[i].name},
                          {"seconds", summary.outcomes[i].seconds},
                          {"kept", summary.outcomes[i].kept}});
    const Json all = {{"format", 1},          {"pipeline", summary.pipeline}, {"seconds", summary.seconds},
                      {"jobs", summary.jobs}, {"removed", summary.pruned},    {"assets", std::move(assets)}};
    return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

namespace {

std::string junit_case(const Asset& asset, const Outcome& out) {
    const std::string head =
        fmt::format("    <testcase classname=\"asset\" name=\"{}\"", escaped(asset.name));
    if (out.verdict == Outcome::Verdict::ok) return head + "/>\n";
    if (out.verdict != Outcome::Verdict::failed)
        return fmt::format("{}>\n      <skipped message=\"{}\"/>\n    </testcase>\n", head,
                           verdict_word(out.verdict));
    const char* kind = out.exit_code == static_cast<int>(ErrorKind::check) ? "failure" : "error";
    std::string body;
    for (const auto& error : out.errors)
        body += escaped(fmt::format("[{}] {} {}\n", error.id, error.message, to_string(error.where)));
    return fmt::format("{0}>\n      <{1} message=\"exit code {2}\">{3}</{1}>\n    </testcase>\n", head, kind,
                       out.exit_code, body);
}

} // namespace

std::string to_junit(const Summary& summary) {
    std::string cases;
    std::size_t failures = 0, errors = summary.errors.size();
    for (const auto& error : summary.errors)
        cases += fmt::format(
            "    <testcase classname=\"batch\" name=\"{}\">\n      <error message=\"{}\">{}</error>\n"
            "    </testcase>\n",
            escaped(error.id), escaped(error.message), escaped(to_string(error.where)));
    for (const std::size_t i : worst_first(summary)) {
        const Outcome& out = summary.outcomes[i];
        cases += junit_case(summary.assets[i], out);
        if (out.verdict != Outcome::Verdict::failed) continue;
        ++(out.exit_code == static_cast<int>(ErrorKind::check) ? failures : errors);
    }
    const std::size_t skipped =
        count(summary, Outcome::Verdict::not_run) + count(summary, Outcome::Verdict::interrupted);
    return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n  <testsuite name=\"{}\" "
                       "tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\">\n{}  </testsuite>\n"
                       "</testsuites>\n",
                       escaped(summary.pipeline), summary.assets.size() + summary.errors.size(), failures,
                       errors, skipped, cases);
}

} // namespace facetmill::batch
