#include "cli/pipe_value.hpp"

#include "base/math/numbers.hpp"
#include "options/lists.hpp"
#include "pipeline/document.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::cli {

std::string expressions(std::string text) {
    for (std::size_t at = 0; (at = text.find("@{", at)) != text.npos;) {
        if (at > 0 && text[at - 1] == '@') {
            text.erase(at - 1, 1);
            ++at;
        } else {
            text[at] = '$';
            at += 2;
        }
    }
    return text;
}

namespace {

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
Value split(const std::string& text, const Mark& mark) {
    Value list = list_of_words(text, mark);
    for (Value& item : list.items) item = scalar(item.text, mark);
    return list;
}

/// Whether commas separate the values of the option.
bool comma_list(const Option& option) {
    if (option.kind == OptionKind::vector) return true;
    if (option.fields && option.fields->short_form == ShortForm::list) return true;
    return option.repeatable && option.one != OptionKind::path && option.one != OptionKind::vector;
}

/// Whether the text is YAML: a map if the option allows it, or nested lists. A path may begin and end with
/// the same characters.
bool is_flow(const std::string& text, const Option* option) {
    if (text.starts_with('{') && text.ends_with('}')) {
        return !option || option->fields || may_be_map(option->one);
    }
    return option && text.starts_with('[') && text.ends_with(']') &&
           text.find_first_of("[{", 1) != text.npos && option->may_be_list() &&
           option->one != OptionKind::path;
}

/// Sets the mark of the whole value, and expands percentages.
void settle_flow(Value& value, const Mark& mark) {
    value.mark = mark;
    if (value.is_scalar() && !value.quoted) value.text = percent(value.text);
    for (auto& item : value.items) settle_flow(item, mark);
    for (auto& entry : value.entries) {
        entry.key_mark = mark;
        settle_flow(entry.value, mark);
    }
}

Value flow(const std::string& text, const Mark& mark, Problems& problems) {
    Problems own;
    Value value = pipeline::parse_yaml(std::make_shared<const SourceText>(SourceText{"", text}), own);
    for (const auto& d : own.all())
        problems.add(mark, d.id, fmt::format("in '{}': {}", text, d.message), d.hint);
    settle_flow(value, mark);
    return value;
}

} // namespace

Value as_one_value(Value list, const Option& option) {
    const bool numbers = std::all_of(list.items.begin(), list.items.end(), [](const Value& item) {
        return item.is_scalar() && parse_real(item.text).has_value();
    });
    if (!option.repeatable || !numbers || !may_be_list(option.one)) return list;
    const Mark mark = list.mark;
    return Value::list({std::move(list)}, mark);
}

Value pipe_value(std::string text, const Option* option, const Mark& mark, Problems& problems) {
    text = expressions(std::move(text));
    if (is_flow(text, option)) return flow(text, mark, problems);
    if (!option || !comma_list(*option) || text.find(',') == text.npos) return scalar(text, mark);
    return as_one_value(split(text, mark), *option);
}

} // namespace facetmill::cli
