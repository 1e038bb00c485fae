#include "cli/pipe_syntax.hpp"

#include "base/numbers.hpp"

#include <algorithm>

namespace facetmill::cli {

namespace {

/// @{x} -> ${x}; @@{ stays @{.
std::string expressions(std::string text) {
    for (std::size_t at = 0; (at = text.find("@{", at)) != text.npos;) {
        if (at > 0 && text[at - 1] == '@')
            text.erase(at - 1, 1), ++at;
        else
            text[at] = '$', at += 2;
    }
    return text;
}

/// "0.5pct of part" -> "0.5% of part".
std::string percent(std::string text) {
    const auto at = text.find("pct");
    if (at == text.npos || !parse_real(text.substr(0, at))) return text;
    const std::string rest = text.substr(at + 3);
    return rest.empty() || rest.starts_with(" of ") ? text.substr(0, at) + "%" + rest : text;
}

Value scalar(const std::string& text, const Mark& mark) {
    return Value::scalar(percent(text), mark, text.empty());
}

/// "1,2,3", or "[1, 2, 3]" as help shows it.
Value split(std::string text, const Mark& mark) {
    if (text.starts_with('[') && text.ends_with(']') && text.find('[', 1) == text.npos) {
        text = text.substr(1, text.size() - 2);
        std::erase(text, ' ');
    }
    Value list = Value::list({}, mark);
    for (std::size_t at = 0; at <= text.size();) {
        const auto end = std::min(text.find(',', at), text.size());
        list.items.push_back(scalar(text.substr(at, end - at), mark));
        at = end + 1;
    }
    return list;
}

/// Whether the short form of a group is a list, or one word of such a list.
bool short_list(const Declaration& group) {
    const Json& schema = group.shorthand_schema;
    if (!schema.contains("anyOf")) return schema.contains("type") && schema["type"] == "array";
    const auto is_list = [](const Json& form) { return form.contains("type") && form["type"] == "array"; };
    const auto is_word = [](const Json& form) { return form.contains("enum"); };
    bool any = false;
    for (const Json& form : schema["anyOf"]) {
        if (!is_list(form) && !is_word(form)) return false;
        any |= is_list(form);
    }
    return any;
}

/// Whether commas part the values of the option.
bool comma_list(const Option& option) {
    if (option.type == "vector") return true;
    if (option.fields && short_list(*option.fields)) return true;
    if (!option.repeatable || !option.schema.contains("anyOf")) return false;
    const Json& one = option.schema["anyOf"][0];
    return one != OptionType<PathText>::schema() && one != OptionType<Vec3>::schema();
}

} // namespace

Value pipe_value(std::string text, const Option* option, const Mark& mark) {
    text = expressions(std::move(text));
    const bool list = option && comma_list(*option) && text.find(',') != text.npos;
    return list ? split(text, mark) : scalar(text, mark);
}

const Option* find_dotted(const Declaration& declaration, std::string_view name) {
    const auto dot = name.find('.');
    const Option* option = declaration.find(name.substr(0, dot));
    if (!option || dot == name.npos) return option;
    return option->fields ? find_dotted(*option->fields, name.substr(dot + 1)) : nullptr;
}

} // namespace facetmill::cli
