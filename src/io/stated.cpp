#include "io/stated.hpp"

#include "base/text/spelling.hpp"
#include "base/text/words.hpp"
#include "io/flatten.hpp"

#include <fmt/format.h>
#include <optional>
#include <utility>

namespace facetmill::io {

namespace {

template <class Owner>
void take(Owner& owner, const Convention& stated) {
    if (stated.unit != Unit::unknown) owner.unit = stated.unit;
    if (stated.up != UpAxis::unknown) owner.up = stated.up;
}

} // namespace

std::string stated_comments(const Scene& scene, std::string_view before, std::string_view after) {
    std::string text;
    if (scene.unit != Unit::unknown)
        text += fmt::format("{}unit: {}{}", before, to_string(scene.unit), after);
    if (scene.up != UpAxis::unknown) text += fmt::format("{}up: {}{}", before, to_string(scene.up), after);
    return text;
}

namespace {

/// Converts spelled-out unit names, such as "Millimeters".
std::optional<Unit> unit_spelled(std::string_view text) {
    const std::string word = lower_case(std::string(text));
    if (const auto known = unit_named(word)) return known;
    constexpr std::pair<std::string_view, Unit> roots[] = {
        {"micromet", Unit::um}, {"micron", Unit::um},  {"millimet", Unit::mm},
        {"centimet", Unit::cm}, {"kilomet", Unit::km}, {"met", Unit::m},
        {"inch", Unit::inch},   {"feet", Unit::foot},  {"foot", Unit::foot}};
    for (const auto& [root, unit] : roots) {
        if (!word.starts_with(root)) continue;
        const std::string_view rest = std::string_view(word).substr(root.size());
        const bool metre = root.ends_with("met");
        for (const std::string_view end : {"er", "re", "ers", "res"})
            if (metre && rest == end) return unit;
        if (!metre && (rest.empty() || rest == "s" || rest == "es")) return unit;
    }
    return {};
}

/// The text after `word` and a colon (or =); none if the comment begins otherwise.
std::optional<std::string_view> value_of(std::string_view comment, std::string_view word) {
    const auto sign = comment.find_first_of(":=");
    if (sign == comment.npos || !same_word(trimmed(comment.substr(0, sign)), word)) return {};
    return trimmed(comment.substr(sign + 1));
}

} // namespace

void take_comment(std::string_view comment, Stated& stated) {
    for (const std::string_view word : {"unit", "units"})
        if (const auto value = value_of(comment, word)) {
            const auto known = unit_spelled(*value);
            if (known) stated.unit = *known;
            stated.no_unit = known ? std::string_view() : *value;
        }
    if (const auto axis = value_of(comment, "up")) {
        stated.no_up = *axis;
        for (const UpAxis known : {UpAxis::y, UpAxis::z})
            if (same_word(*axis, to_string(known))) {
                stated.up = known;
                stated.no_up.clear();
            }
    }
}

bool states(std::string_view comment) {
    Stated s;
    take_comment(comment, s);
    return s.unit != Unit::unknown || s.up != UpAxis::unknown || !s.no_unit.empty() || !s.no_up.empty();
}

Stated stated_in_lines(std::string_view text, std::string_view keyword) {
    Stated stated;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::size_t comment = std::min(line.find('#'), line.size());
        const std::string_view words = trimmed(line.substr(0, comment));
        if (words.empty())
            take_comment(line.substr(std::min(comment + 1, line.size())), stated);
        else if (!keyword.empty() && words.ends_with(keyword))
            keyword = {};
        else
            break;
    }
    return stated;
}

void take_stated(Scene& scene, const Stated& stated, const std::string& file, const ReadSettings& settings,
                 ReadLog& log) {
    take(scene, stated);
    const auto warn = [&](const char* id, std::string_view what, const std::string& value, std::string hint) {
        constexpr std::size_t most = 40; // characters of a comment shown in a message
        log.warnings.push_back({Severity::warning, id,
                                fmt::format("'{}' states the {} '{}', which is unknown and therefore ignored",
                                            file, what, one_line(value.substr(0, most))),
                                file_mark(file), std::move(hint), false});
    };
    if (!stated.no_unit.empty() && !settings.unit)
        warn("W-UNITS", "unit", stated.no_unit,
             "give the unit: load: {unit: mm}; units are um, mm, cm, m, km, in and ft");
    if (!stated.no_up.empty() && !settings.up)
        warn("W-UP", "up axis", stated.no_up, "give the up axis: load: {up: z}; it is y or z");
}

void take_stated(FileHeader& header, const Convention& stated) { take(header, stated); }

std::vector<ReadWarning> overridden(const std::string& file, const Convention& stated,
                                    const ReadSettings& settings) {
    std::vector<ReadWarning> warnings;
    const auto warn = [&](const char* what, std::string_view was, std::string_view given) {
        warnings.push_back(
            {Severity::warning, "W-OVERRIDDEN",
             fmt::format("'{}' states {} {}, but {} is used instead, without a conversion", file, what, was,
                         given),
             file_mark(file),
             fmt::format("leave out the option; to convert, use transform: {{{}: {}}}", what, given), false});
    };
    if (settings.unit && stated.unit != Unit::unknown && *settings.unit != stated.unit)
        warn("unit", to_string(stated.unit), to_string(*settings.unit));
    if (settings.up && stated.up != UpAxis::unknown && *settings.up != stated.up)
        warn("up", to_string(stated.up), to_string(*settings.up));
    return warnings;
}

} // namespace facetmill::io
