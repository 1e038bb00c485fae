#include "stages/probe/rows.hpp"

#include "base/hash.hpp"
#include "io/csv.hpp"
#include "stage/options/lists.hpp"

#include <array>
#include <fmt/format.h>

namespace facetmill::rows {

namespace {

bool refuse(const Value& value, std::size_t columns, Problems& problems) {
    problems.add(
        value.mark, "E-TYPE",
        fmt::format("expected rows of {} numbers or a .csv file, found {}", columns, value.described()),
        columns == 3
            ? "[0, 0, 1], [[0, 0, 1], [1, 2, 3]] or points.csv; on the command line 0,0,1 or '0,0,1; 1,2,3'"
            : "[0, 0, 9, 0, 0, -1] or lines.csv; on the command line 0,0,9,0,0,-1");
    return false;
}

bool parse_row(const Value& value, std::size_t columns, std::vector<double>& numbers, Problems& problems) {
    if (!value.is_list() || value.items.size() != columns) return refuse(value, columns, problems);
    for (const auto& item : value.items) {
        if (item.deferred) {
            numbers.push_back(0);
            continue;
        }
        const auto number = item.as_real();
        if (!number) return refuse(item, columns, problems);
        numbers.push_back(*number);
    }
    return true;
}

} // namespace

bool parse(const Value& value, std::size_t columns, std::vector<double>& numbers, std::string& file,
           Problems& problems) {
    if (value.deferred) return true;
    if (value.is_scalar() && (value.text.find(',') == std::string::npos || value.text.ends_with(".csv"))) {
        file = value.text;
        return !file.empty();
    }
    if (value.is_scalar()) {
        const auto list = list_in_text(value);
        Problems of_row; // the whole text is what people are told of
        return (list && parse(*list, columns, numbers, file, of_row)) || refuse(value, columns, problems);
    }
    if (!value.is_list() || value.items.empty()) return refuse(value, columns, problems);
    if (!value.items[0].is_list()) return parse_row(value, columns, numbers, problems);
    bool good = true;
    for (const auto& item : value.items) good &= parse_row(item, columns, numbers, problems);
    return good;
}

Json schema(std::size_t columns) {
    const Json row = {{"type", "array"},
                      {"items", {{"type", Json::array({"number", "string"})}}},
                      {"minItems", columns},
                      {"maxItems", columns}};
    return {{"anyOf",
             Json::array({row, {{"type", "array"}, {"items", row}, {"minItems", 1}}, {{"type", "string"}}})}};
}

std::vector<double> read(const std::string& file, std::size_t columns, Context& context) {
    const io::Input input = io::Input::open(context.places().input(file));
    auto& inputs = context.run().record.inputs;
    inputs.push_back({file, input.stored().size(), sha256(input.stored()), {}});
    constexpr std::array<std::string_view, 3> names{"x", "y", "z"};
    return io::read_table(input, columns,
                          columns == 3 ? std::span<const std::string_view>(names)
                                       : std::span<const std::string_view>());
}

} // namespace facetmill::rows
