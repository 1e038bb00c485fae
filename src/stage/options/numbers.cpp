#include "stage/options/numbers.hpp"

#include <fmt/format.h>

namespace facetmill {

Value split_at_commas(const Value& value) {
    std::string text = value.text;
    std::erase(text, ' ');
    if (text.starts_with('[') && text.ends_with(']')) text = text.substr(1, text.size() - 2);
    Value list = Value::list({}, value.mark);
    for (std::size_t at = 0; at <= text.size();) {
        const auto end = std::min(text.find(',', at), text.size());
        list.items.push_back(Value::scalar(text.substr(at, end - at), value.mark));
        at = end + 1;
    }
    return list;
}

bool parse_numbers(const Value& value, std::span<double> out, std::string_view expected, Problems& problems) {
    if (value.deferred) return true;
    if (value.is_scalar() && value.text.find(',') != std::string::npos)
        return parse_numbers(split_at_commas(value), out, expected, problems);
    if (!value.is_list() || value.items.size() != out.size()) {
        problems.add(value.mark, "E-TYPE", fmt::format("expected {}, found {}", expected, value.described()));
        return false;
    }
    bool good = true;
    for (std::size_t i = 0; i < out.size(); ++i)
        good &= OptionType<double>::parse(value.items[i], out[i], problems);
    return good;
}

Json numbers_schema(std::size_t count) {
    return {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", count}, {"maxItems", count}};
}

} // namespace facetmill
