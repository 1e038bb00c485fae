#include "base/text/spelling.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

char lower_case(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

} // namespace

std::string lower_case(std::string text) {
    for (char& c : text) c = lower_case(c);
    return text;
}

bool same_word(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return lower_case(x) == lower_case(y); });
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = a[i - 1] == b[j - 1];
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        before = last;
        last = row;
    }
    return last[b.size()];
}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
    const std::size_t limit = std::min<std::size_t>(3, word.size() / 2);
    std::size_t best = limit + 1;
    std::string found;
    const std::string in_lower_case = lower_case(std::string(word));
    for (const auto& candidate : candidates) {
        if (same_word(word, candidate)) return candidate;
        std::size_t distance =
            std::min(edit_distance(word, candidate), edit_distance(in_lower_case, candidate));
        const bool prefix = word.size() >= 3 && candidate.starts_with(word);
        if (prefix) distance = std::min<std::size_t>(distance, 1);
        if (distance < best) {
            best = distance;
            found = candidate;
        }
    }
    return found;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates,
                         std::string otherwise) {
    const std::string name = nearest(word, candidates);
    return name.empty() ? std::move(otherwise) : fmt::format("did you mean '{}'?", name);
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
    return did_you_mean(word, candidates, fmt::format("expected one of: {}", fmt::join(candidates, ", ")));
}

} // namespace facetmill
