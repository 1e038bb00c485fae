#include "io/import/stated_unit.hpp"

#include "base/math/numbers.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace facetmill::io::import {

namespace {

constexpr std::string_view blanks = " \t\r\n";

std::string_view trimmed_left(std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(blanks), text.size()));
}

/// The definition of "#12", from its "=" to its ";". Empty if there is none.
std::string_view entity(std::string_view file, std::string_view id) {
    for (std::size_t at = 0; (at = file.find(id, at)) != file.npos;) {
        at += id.size();
        const std::string_view rest = trimmed_left(file.substr(at));
        if (rest.starts_with('=')) return rest.substr(0, rest.find(';'));
    }
    return {};
}

/// The text without blanks in upper case, because SI_UNIT ( .MILLI. , .METRE. ) may be spread over lines.
std::string compact(std::string_view text) {
    std::string all;
    for (const char c : text)
        if (blanks.find(c) == blanks.npos) all += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return all;
}

Unit unit_of_entity(std::string_view definition) {
    const std::string text = compact(definition);
    constexpr std::array<std::pair<std::string_view, Unit>, 8> known{{
        {"SI_UNIT($,.METRE.)", Unit::m},
        {"SI_UNIT(.MILLI.,.METRE.)", Unit::mm},
        {"SI_UNIT(.CENTI.,.METRE.)", Unit::cm},
        {"SI_UNIT(.MICRO.,.METRE.)", Unit::um},
        {"SI_UNIT(.KILO.,.METRE.)", Unit::km},
        {"CONVERSION_BASED_UNIT('INCH", Unit::inch},
        {"CONVERSION_BASED_UNIT('IN'", Unit::inch},
        {"CONVERSION_BASED_UNIT('FOOT", Unit::foot},
    }};
    for (const auto& [spelling, unit] : known)
        if (text.find(spelling) != text.npos) return unit;
    return Unit::unknown;
}

/// The text of the global section: the lines with a G in column 73.
std::string global_section(std::string_view file) {
    constexpr std::size_t column = 72;
    std::string text;
    while (!file.empty()) {
        const std::string_view line = file.substr(0, file.find('\n'));
        file.remove_prefix(std::min(line.size() + 1, file.size()));
        if (line.size() <= column) continue;
        if (line[column] == 'G') text += line.substr(0, column);
        if (line[column] == 'D') break;
    }
    return text;
}

/// The parameters of the global section. Texts have their length in front ("4HINCH"), and may contain the
/// delimiter, which the first parameter defines.
std::vector<std::string> parameters(std::string_view text) {
    constexpr std::size_t most = 26;
    const bool defines = text.starts_with("1H") && text.size() > 2;
    const char delimiter = defines ? text[2] : ',';
    std::vector<std::string> all;
    while (!text.empty() && all.size() < most) {
        text = trimmed_left(text);
        const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
        std::size_t begin = 0;
        if (digits > 0 && digits < text.size() && text[digits] == 'H')
            begin = digits + 1 + static_cast<std::size_t>(parse_integer(text.substr(0, digits)).value_or(0));
        const std::size_t end = std::min(text.find(delimiter, std::min(begin, text.size())), text.size());
        all.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return all;
}

} // namespace

Unit unit_of_step(std::string_view file) {
    constexpr std::string_view context = "GLOBAL_UNIT_ASSIGNED_CONTEXT";
    const std::size_t at = file.find(context);
    if (at == file.npos) return Unit::unknown;
    std::string_view list = file.substr(at + context.size());
    constexpr std::size_t most = 1000;
    constexpr int most_units = 16; // each is sought in the whole file
    list = list.substr(0, std::min(list.find(')'), most));
    std::size_t next = 0;
    for (int k = 0; k < most_units && (next = list.find('#', next)) != list.npos; ++k, ++next) {
        const std::size_t end = list.find_first_not_of("0123456789", next + 1);
        if (end == next + 1) continue; // no number
        const std::string_view definition = entity(file, list.substr(next, end - next));
        if (definition.find("LENGTH_UNIT") != definition.npos) return unit_of_entity(definition);
    }
    return Unit::unknown;
}

Unit unit_of_iges(std::string_view file) {
    constexpr std::size_t flag = 13;
    constexpr std::array<std::pair<std::string_view, Unit>, 7> known{{{"1", Unit::inch},
                                                                      {"2", Unit::mm},
                                                                      {"4", Unit::foot},
                                                                      {"6", Unit::m},
                                                                      {"7", Unit::km},
                                                                      {"9", Unit::um},
                                                                      {"10", Unit::cm}}};
    const std::vector<std::string> all = parameters(global_section(file));
    if (all.size() <= flag) return Unit::unknown;
    const std::string text = compact(all[flag]);
    for (const auto& [number, unit] : known)
        if (text == number) return unit;
    return Unit::unknown;
}

} // namespace facetmill::io::import
