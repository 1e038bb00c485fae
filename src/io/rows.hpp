#pragma once
// Tables with a row per object: CSV, and JSON lines. A row is a flat JSON object, whose keys are the columns.

#include "base/json.hpp"

#include <string>

namespace facetmill::io {

enum class RowFormat { csv, json_lines };
/// By the suffix: .csv or .jsonl. Throws a usage error (E-FORMAT) for others.
[[nodiscard]] RowFormat row_format(const std::string& path);

/// The plain values of an object, without lists and objects in it.
[[nodiscard]] Json flat_row(const Json& object);

/// The heading of a CSV file; empty for JSON lines.
[[nodiscard]] std::string row_heading(const Json& row, RowFormat format);
/// The row as a line. In CSV, null is an empty cell, and texts follow csv_text.
[[nodiscard]] std::string row_line(const Json& row, RowFormat format);

} // namespace facetmill::io
