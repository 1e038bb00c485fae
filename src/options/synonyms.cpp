#include "options/synonyms.hpp"

#include "base/text/spelling.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

std::string with_underscores(std::string_view word) {
    std::string same = lower_case(std::string(word));
    std::replace(same.begin(), same.end(), '-', '_');
    return same;
}

struct Match {
    std::string_view name, how;
};

std::vector<Match> matches(std::string_view other_name, const std::vector<KnownName>& known) {
    const std::string word = with_underscores(other_name);
    std::vector<Match> found;
    for (const KnownName& one : known)
        for (const Synonyms& synonyms : one.synonyms)
            if (has_word(synonyms.words, word)) found.push_back({one.name, synonyms.how});
    std::stable_sort(found.begin(), found.end(),
                     [](const Match& a, const Match& b) { return a.name < b.name; });
    return found;
}

std::vector<std::string> names_in(const std::vector<Match>& found) {
    std::vector<std::string> names;
    names.reserve(found.size());
    for (const Match& match : found) names.emplace_back(match.name);
    return names;
}

} // namespace

bool has_word(std::string_view words, std::string_view word) {
    return !word.empty() && word.find(' ') == word.npos &&
           fmt::format(" {} ", words).find(fmt::format(" {} ", word)) != std::string::npos;
}

std::vector<std::string> options_called(std::string_view word, const std::vector<KnownName>& known) {
    return names_in(matches(word, known));
}

std::vector<std::string> options_of_same_value(std::string_view word, const std::vector<KnownName>& known) {
    auto found = matches(word, known);
    std::erase_if(found, [](const Match& match) { return !match.how.empty(); });
    return names_in(found);
}

bool means_report(std::string_view option) {
    constexpr std::string_view words[] = {"report",   "reports", "junit",       "junit_xml",
                                          "junitxml", "xunit",   "html_report", "sarif"};
    return std::find(std::begin(words), std::end(words), with_underscores(option)) != std::end(words);
}

std::string hint_for_option(std::string_view word, const std::vector<KnownName>& known,
                            std::string otherwise) {
    std::string names;
    for (const Match& match : matches(word, known)) {
        if (!match.how.empty()) return fmt::format("here it is {}", match.how);
        names += fmt::format("{}'{}'", names.empty() ? "" : " or ", match.name);
    }
    if (!names.empty()) return fmt::format("'{}' is called {} here", word, names);
    if (means_report(word))
        return "a report is written by the command: --report FILE.xml (JUnit), .json, .html, .md or .txt "
               "before the first stage, or report: FILE.xml in a pipeline file";
    std::vector<std::string> all;
    all.reserve(known.size());
    for (const KnownName& one : known) all.push_back(one.name);
    return otherwise.empty() ? suggestion(word, all) : did_you_mean(word, all, std::move(otherwise));
}

} // namespace facetmill
