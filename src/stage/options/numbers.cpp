#include "stage/options/numbers.hpp"

#include "options/lists.hpp"

#include <fmt/format.h>

namespace facetmill {

bool parse_numbers(const Value& value, std::span<double> out, std::string_view expected, Problems& problems) {
    if (value.deferred) return true;
    if (value.is_scalar() && value.text.find(',') != std::string::npos)
        if (const auto list = list_in_text(value)) return parse_numbers(*list, out, expected, problems);
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
