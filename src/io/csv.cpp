#include "io/csv.hpp"

#include "base/math/numbers.hpp"
#include "base/text/spelling.hpp"
#include "base/text/words.hpp"
#include "io/text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::io {

namespace {

bool is_separator(char c) { return c == ',' || c == ';' || c == '\t' || c == ' ' || c == '"'; }

std::string_view skip_parting(std::string_view line) {
    while (!line.empty() && is_separator(line.front())) line.remove_prefix(1);
    return line;
}

/// Reads a number from the start of the line; false without a number.
bool take_number(std::string_view& line, double& value) {
    const std::string_view rest = skip_parting(line);
    const char *at = rest.data(), *end = rest.data() + rest.size();
    if (!scan_real(at, end, value)) return false;
    if (at != end && !is_separator(*at)) return false;
    line = {at, static_cast<std::size_t>(end - at)};
    return true;
}

/// The separator of a heading's cells.
char delimiter_of(std::string_view heading) {
    for (const char c : {',', ';', '\t'})
        if (heading.find(c) != heading.npos) return c;
    return ' ';
}

std::string_view bare_cell(std::string_view cell) {
    while (!cell.empty() && is_separator(cell.front())) cell.remove_prefix(1);
    while (!cell.empty() && is_separator(cell.back())) cell.remove_suffix(1);
    return cell;
}

/// The cells of a line, including empty cells; consecutive blanks separate once.
std::vector<std::string_view> cells_of(std::string_view line, char delimiter) {
    std::vector<std::string_view> cells;
    for (std::size_t at = 0; at <= line.size();) {
        const auto end = std::min(line.find(delimiter, at), line.size());
        if (delimiter != ' ' || end > at) cells.push_back(bare_cell(line.substr(at, end - at)));
        at = end + 1;
    }
    return cells;
}

/// The indices of the named columns; empty if a name is missing or the columns are already the first.
std::vector<std::size_t> places_of(std::span<const std::string_view> names,
                                   const std::vector<std::string_view>& heading) {
    std::vector<std::size_t> places;
    for (const auto name : names)
        for (std::size_t c = 0; c < heading.size(); ++c)
            if (same_word(heading[c], name)) {
                places.push_back(c);
                break;
            }
    bool first = true; // the columns are already in order
    for (std::size_t i = 0; i < places.size(); ++i) first = first && places[i] == i;
    return places.size() == names.size() && !first ? places : std::vector<std::size_t>{};
}

/// Reads line by line and counts lines for messages.
class Table {
  public:
    Table(const Input& input, std::size_t columns, std::span<const std::string_view> names)
        : input_(input), columns_(columns), names_(names),
          text_(without_byte_order_mark(as_text(input.bytes()))) {}

    std::vector<double> read() {
        bool first = true;
        while (!text_.empty()) {
            const std::string_view whole = next_line(), line = skip_parting(whole);
            if (line.empty()) continue;
            double value = 0;
            std::string_view peek = line;
            if (first && !take_number(peek, value)) {
                delimiter_ = delimiter_of(whole);
                places_ = places_of(names_, cells_of(whole, delimiter_));
            } else if (places_.empty())
                read_first(line);
            else
                read_places(whole);
            first = false;
        }
        return std::move(numbers_);
    }

  private:
    /// The next line, without the text after #.
    std::string_view next_line() {
        ++number_;
        const auto end = text_.find_first_of("\r\n");
        const std::string_view line = text_.substr(0, end);
        const bool pair = end != text_.npos && text_.substr(end, 2) == "\r\n";
        text_.remove_prefix(end == text_.npos ? text_.size() : end + (pair ? 2 : 1));
        return line.substr(0, line.find('#'));
    }

    void keep(double value) {
        if (!std::isfinite(value)) malformed(input_.name(), number_, "E-CSV", "a number that is not finite");
        numbers_.push_back(value);
    }

    [[noreturn]] void expected_number(std::string_view found) const {
        malformed(input_.name(), number_, "E-CSV",
                  fmt::format("expected a number, found {}", in_quotes(found)));
    }

    /// Reads the first columns.
    void read_first(std::string_view line) {
        double value = 0;
        for (std::size_t c = 0; c < columns_; ++c) {
            if (!take_number(line, value)) {
                const std::string_view rest = skip_parting(line);
                if (rest.empty())
                    malformed(input_.name(), number_, "E-CSV",
                              fmt::format("the row has {} numbers, expected {}", c, columns_));
                expected_number(rest.substr(0, rest.find_first_of(",; \t")));
            }
            keep(value);
        }
    }

    /// Reads the columns that the heading names.
    void read_places(std::string_view line) {
        const auto cells = cells_of(line, delimiter_);
        for (const std::size_t place : places_) {
            if (place >= cells.size())
                malformed(input_.name(), number_, "E-CSV",
                          fmt::format("the row has {} columns, expected {}", cells.size(), place + 1));
            double value = 0;
            std::string_view cell = cells[place];
            if (!take_number(cell, value) || !skip_parting(cell).empty()) expected_number(cells[place]);
            keep(value);
        }
    }

    const Input& input_;
    std::size_t columns_;
    std::span<const std::string_view> names_;
    std::string_view text_;
    int number_ = 0;
    char delimiter_ = ',';
    std::vector<std::size_t> places_; ///< indices of the named columns; empty: the first columns
    std::vector<double> numbers_;
};

} // namespace

std::vector<double> read_table(const Input& input, std::size_t columns,
                               std::span<const std::string_view> names) {
    return Table(input, columns, names).read();
}

std::string csv_number(double x) { return std::isfinite(x) ? to_string(x) : ""; }

std::string csv_text(const std::string& text) {
    const std::string cell = text.find_first_of("=+-@\t\r") == 0 ? "'" + text : text;
    if (cell.find_first_of(",;\"\r\n") == cell.npos) return cell;
    std::string quoted = "\"";
    for (const char c : cell) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

} // namespace facetmill::io
