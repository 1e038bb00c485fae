#pragma once
// Tables of numbers: probe inputs and answers.

#include "io/bytes.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace facetmill::io {

/// Reads rows of `columns` numbers, one row a line, separated by commas, semicolons, tabs or blanks. Ignores
/// further columns, empty lines, text after #, and a first line that does not start with a number (a
/// heading). If the heading has all of `names`, in any case, it selects the columns; otherwise the first
/// columns are read. Returns the numbers row by row. Throws a malformed-input error (E-CSV) with the line.
[[nodiscard]] std::vector<double> read_table(const Input& input, std::size_t columns,
                                             std::span<const std::string_view> names = {});

/// A number as the shortest text that reads back the same; empty when it is not finite.
[[nodiscard]] std::string csv_number(double x);
/// A text, quoted if CSV requires it. An apostrophe goes before =, +, -, @, tab and carriage return at the
/// start, because spreadsheets would run the text as a formula.
[[nodiscard]] std::string csv_text(const std::string& text);

} // namespace facetmill::io
