#include "io/stated.hpp"

#include "base/words.hpp"

#include <fmt/format.h>

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

void take_comment(std::string_view comment, Convention& stated) {
    const std::string_view text = trimmed(comment);
    constexpr std::string_view unit = "unit:", up = "up:";
    if (text.starts_with(unit)) {
        if (const auto known = unit_named(trimmed(text.substr(unit.size())))) stated.unit = *known;
    } else if (text.starts_with(up)) {
        const std::string_view axis = trimmed(text.substr(up.size()));
        for (const UpAxis known : {UpAxis::y, UpAxis::z})
            if (axis == to_string(known)) stated.up = known;
    }
}

Convention stated_in_lines(std::string_view text, std::string_view keyword) {
    Convention stated;
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

void take_stated(Scene& scene, const Convention& stated) { take(scene, stated); }
void take_stated(FileHeader& header, const Convention& stated) { take(header, stated); }

std::vector<ReadWarning> overridden(const std::string& file, const Convention& stated,
                                    const ReadSettings& settings) {
    std::vector<ReadWarning> warnings;
    const auto warn = [&](const char* what, std::string_view was, std::string_view given) {
        warnings.push_back({Severity::warning, "W-OVERRIDDEN",
                            fmt::format("'{}' states {} {}, and is taken as {}: nothing is converted", file,
                                        what, was, given),
                            file_mark(file),
                            fmt::format("leave it out; transform: {{{}: {}}} converts", what, given), false});
    };
    if (settings.unit && stated.unit != Unit::unknown && *settings.unit != stated.unit)
        warn("unit", to_string(stated.unit), to_string(*settings.unit));
    if (settings.up && stated.up != UpAxis::unknown && *settings.up != stated.up)
        warn("up", to_string(stated.up), to_string(*settings.up));
    return warnings;
}

} // namespace facetmill::io
