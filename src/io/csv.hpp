#pragma once
// Tables of numbers: what probes are read from and answers are written to.

#include "io/bytes.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace facetmill::io {

/// Reads rows of `columns` numbers each, one row a line, separated by commas, semicolons, tabs or blanks;
/// further columns are left alone. Empty lines and what follows # are skipped, and so is a first line without
/// a number at its start (a heading). When the heading has all of `names`, in upper or lower case, their
/// columns are read wherever they stand; else the first ones. The numbers come row by row. Throws malformed
/// (E-CSV) with the line.
std::vector<double> read_table(const Input& input, std::size_t columns,
                               std::span<const std::string_view> names = {});

/// A number as the shortest text that reads back the same; empty when it is not finite.
std::string csv_number(double x);
/// A text, in quotes when it needs them.
std::string csv_text(const std::string& text);

} // namespace facetmill::io
