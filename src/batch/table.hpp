#pragma once
// Tables of parameters: a row an asset, a column a parameter.

#include "options/value.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace facetmill::batch {

struct Cell {
    std::string param, text;
    Mark where;
    std::optional<Value> list{}; ///< of YAML; text is then what -D would take
};
/// The cells that are not empty.
using Row = std::vector<Cell>;

/// Reads a table: YAML (.yaml, .yml) is a list of maps; anything else is CSV as RFC 4180 has it (Y.
/// Shafranovich, "Common format and MIME type for comma-separated values (CSV) files", 2005), with a heading,
/// separated by the first of comma, semicolon and tab that the heading has. Throws malformed (E-TABLE),
/// missing when there is no file.
std::vector<Row> read_params_table(const std::filesystem::path& file);

} // namespace facetmill::batch
