#include "base/text/glob.hpp"

#include <algorithm>
#include <optional>
#include <string>

namespace facetmill {

namespace fs = std::filesystem;

namespace {

/// Alternatives in braces, with the text around them.
struct Alternatives {
    std::size_t begin, end; ///< of the braces
    std::vector<std::string_view> all;
};

/// The first braces within a component of a path that hold a comma outside further braces.
std::optional<Alternatives> first_alternatives(std::string_view text) {
    for (std::size_t begin = text.find('{'); begin != text.npos; begin = text.find('{', begin + 1)) {
        Alternatives found{begin, begin, {}};
        std::size_t depth = 0, from = begin + 1;
        for (std::size_t i = begin; i < text.size() && text[i] != '/'; ++i) {
            if (text[i] == '{') ++depth;
            const bool closes = text[i] == '}' && --depth == 0;
            if (!closes && !(text[i] == ',' && depth == 1)) continue;
            found.all.push_back(text.substr(from, i - from));
            from = i + 1;
            if (!closes) continue;
            found.end = i + 1;
            break;
        }
        if (found.end > begin && found.all.size() > 1) return found;
    }
    return {};
}

} // namespace

bool is_glob(std::string_view text) {
    return text.find_first_of("*?[") != text.npos || first_alternatives(text).has_value();
}

namespace {

/// Matches one character against the pattern's next unit (no star). Returns the length of the unit, or none
/// without a match.
std::optional<std::size_t> matched_unit(std::string_view pattern, char c) {
    if (pattern.empty()) return {};
    if (pattern[0] == '?') return 1;
    if (pattern[0] == '\\' && pattern.size() > 1)
        return pattern[1] == c ? std::optional<std::size_t>(2) : std::nullopt;
    if (pattern[0] != '[') return pattern[0] == c ? std::optional<std::size_t>(1) : std::nullopt;
    const bool negated = pattern.size() > 1 && (pattern[1] == '!' || pattern[1] == '^');
    std::size_t i = negated ? 2 : 1;
    bool in = false;
    for (bool first = true; i < pattern.size() && (first || pattern[i] != ']'); first = false) {
        if (i + 2 < pattern.size() && pattern[i + 1] == '-' && pattern[i + 2] != ']') {
            in |= pattern[i] <= c && c <= pattern[i + 2];
            i += 3;
        } else {
            in |= pattern[i++] == c;
        }
    }
    if (i >= pattern.size())
        return c == '[' ? std::optional<std::size_t>(1) : std::nullopt; // no closing bracket
    return in != negated ? std::optional<std::size_t>(i + 1) : std::nullopt;
}

/// As glob_matches, with alternatives in braces.
bool component_matches(const std::string& pattern, std::string_view text) {
    const auto some = first_alternatives(pattern);
    if (!some) return glob_matches(pattern, text);
    return std::any_of(some->all.begin(), some->all.end(), [&](std::string_view one) {
        return component_matches(
            pattern.substr(0, some->begin) + std::string(one) + pattern.substr(some->end), text);
    });
}

void expand(const fs::path& base, std::vector<fs::path>::const_iterator component,
            std::vector<fs::path>::const_iterator end, std::vector<fs::path>& found) {
    std::error_code ignored;
    if (component == end) {
        if (fs::is_regular_file(base, ignored)) found.push_back(base);
        return;
    }
    const std::string name = component->generic_string();
    if (!is_glob(name)) return expand(base / name, component + 1, end, found);
    if (name == "**") expand(base, component + 1, end, found);
    for (const auto& entry : fs::directory_iterator(base.empty() ? fs::path(".") : base, ignored)) {
        const std::string child = entry.path().filename().generic_string();
        if (child.starts_with('.') && !name.starts_with('.')) continue;
        if (name == "**") {
            if (entry.is_directory(ignored) && !entry.is_symlink(ignored))
                expand(base / child, component, end, found);
        } else if (component_matches(name, child)) {
            expand(base / child, component + 1, end, found);
        }
    }
}

} // namespace

bool glob_matches(std::string_view pattern, std::string_view text) {
    std::size_t p = 0, t = 0;
    std::optional<std::size_t> star; // position after the last star, and the current end of its match
    std::size_t run_end = 0;
    while (t < text.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = ++p;
            run_end = t;
        } else if (const auto unit = matched_unit(pattern.substr(p), text[t])) {
            p += *unit;
            ++t;
        } else if (star) {
            p = *star;
            t = ++run_end;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

namespace {

using Component = std::vector<fs::path>::const_iterator;

bool components_match(Component pattern, Component pattern_end, Component path, Component path_end) {
    if (pattern == pattern_end) return path == path_end;
    if (*pattern == "**")
        return components_match(pattern + 1, pattern_end, path, path_end) ||
               (path != path_end && components_match(pattern, pattern_end, path + 1, path_end));
    return path != path_end && component_matches(pattern->generic_string(), path->generic_string()) &&
           components_match(pattern + 1, pattern_end, path + 1, path_end);
}

} // namespace

bool glob_matches_path(const fs::path& pattern, const fs::path& path) {
    const std::vector<fs::path> wanted(pattern.begin(), pattern.end()), is(path.begin(), path.end());
    return components_match(wanted.begin(), wanted.end(), is.begin(), is.end());
}

std::vector<fs::path> expand_glob(const fs::path& pattern) {
    std::error_code ignored;
    if (!is_glob(pattern.generic_string()) || fs::exists(pattern, ignored)) return {pattern};
    const fs::path below = pattern.relative_path();
    std::vector<fs::path> components(below.begin(), below.end());
    if (components.back() == "**") components.emplace_back("*"); // at the end, ** matches all files below
    std::vector<fs::path> found;
    expand(pattern.root_path(), components.begin(), components.end(), found);
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return a.generic_string() < b.generic_string(); });
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

} // namespace facetmill
