#include "io/rows.hpp"

#include "base/error.hpp"
#include "io/csv.hpp"

#include <fmt/format.h>

namespace facetmill::io {

namespace {

std::string cell_of(const Json& value) {
    if (value.is_string()) return csv_text(value.get<std::string>());
    if (value.is_number_float()) return csv_number(value.get<double>());
    return value.is_null() ? "" : value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace

RowFormat row_format(const std::string& path) {
    if (path.ends_with(".csv")) return RowFormat::csv;
    if (path.ends_with(".jsonl")) return RowFormat::json_lines;
    throw Error(ErrorKind::usage, "E-FORMAT", fmt::format("'{}' is not a name for a table", path),
                "use a name that ends in .csv or .jsonl");
}

Json flat_row(const Json& object) {
    Json row = Json::object();
    for (const auto& [key, value] : object.items())
        if (!value.is_structured()) row[key] = value;
    return row;
}

std::string row_heading(const Json& row, RowFormat format) {
    if (format == RowFormat::json_lines) return {};
    std::string line;
    for (const auto& [key, value] : row.items()) line += (line.empty() ? "" : ",") + csv_text(key);
    return line + "\n";
}

std::string row_line(const Json& row, RowFormat format) {
    if (format == RowFormat::json_lines)
        return row.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    std::string line;
    bool first = true;
    for (const auto& [key, value] : row.items()) {
        if (!std::exchange(first, false)) line += ",";
        line += cell_of(value);
    }
    return line + "\n";
}

} // namespace facetmill::io
