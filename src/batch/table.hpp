#pragma once
// Tables of parameters: one asset per row, one parameter per column.

#include "options/value.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace facetmill::batch {

struct Cell {
    std::string param, text;
    Mark where;
    std::optional<Value> list{}; ///< from YAML; text then has -D's syntax
};
/// The non-empty cells.
using Row = std::vector<Cell>;

/// Reads a table. YAML (.yaml, .yml) is a list of maps. GeoJSON (.geojson) has a row per feature: `feature`,
/// its polygon as WKT, and `name`, its property name or id, its own id, or its number. Other files are CSV
/// according to RFC 4180 (Y. Shafranovich, "Common format and MIME type for comma-separated values (CSV)
/// files", 2005) with a heading. The separator is the first comma, semicolon or tab in the heading. Throws a
/// malformed-input error (E-TABLE), and a missing-file error without a file.
[[nodiscard]] std::vector<Row> read_params_table(const std::filesystem::path& file);

} // namespace facetmill::batch
