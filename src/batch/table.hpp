#pragma once
// Tables of parameters: a row per asset, a column per parameter.

#include "options/value.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace facetmill::batch {

struct Cell {
    std::string param, text;
    Mark where;
    std::optional<Value> list{}; ///< for a YAML list; text is then the notation of -D
};
/// The nonempty cells.
using Row = std::vector<Cell>;

/// Reads a table. YAML (.yaml, .yml) is a list of maps. Other files are CSV as in RFC 4180 (Y. Shafranovich,
/// "Common format and MIME type for comma-separated values (CSV) files", 2005) with a heading. The separator
/// is the first of comma, semicolon and tab that occurs in the heading. Throws malformed (E-TABLE), and
/// missing if the file does not exist.
std::vector<Row> read_params_table(const std::filesystem::path& file);

} // namespace facetmill::batch
