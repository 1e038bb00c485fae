#include "io/stated.hpp"

#include "base/words.hpp"

#include <fmt/format.h>

namespace facetmill::io {

namespace {

/// A line, without the CR at its end either.
std::string_view trimmed_line(std::string_view text) {
    text = trimmed(text);
    return text.ends_with('\r') ? trimmed(text.substr(0, text.size() - 1)) : text;
}

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
        const std::size_t end = std::min(text.find('\n'), text.size() - 1);
        const std::string_view line = trimmed_line(text.substr(0, end + (text[end] != '\n')));
        text.remove_prefix(end + 1);
        if (line.starts_with('#'))
            take_comment(line.substr(1), stated);
        else if (!keyword.empty() && line.ends_with(keyword))
            keyword = {};
        else if (!line.empty())
            break;
    }
    return stated;
}

void take_stated(Scene& scene, const Convention& stated) { take(scene, stated); }
void take_stated(FileHeader& header, const Convention& stated) { take(header, stated); }

} // namespace facetmill::io
