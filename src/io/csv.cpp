#include "io/csv.hpp"

#include "base/numbers.hpp"
#include "io/text.hpp"

#include <cmath>
#include <fmt/format.h>

namespace facetmill::io {

namespace {

bool parts(char c) { return c == ',' || c == ';' || c == '\t' || c == ' ' || c == '"'; }

std::string_view skip_parting(std::string_view line) {
    while (!line.empty() && parts(line.front())) line.remove_prefix(1);
    return line;
}

/// Takes a number off the front of the line; false when something else is there.
bool take_number(std::string_view& line, double& value) {
    const std::string_view rest = skip_parting(line);
    const char *at = rest.data(), *end = rest.data() + rest.size();
    if (!scan_real(at, end, value)) return false;
    if (at != end && !parts(*at)) return false;
    line = {at, static_cast<std::size_t>(end - at)};
    return true;
}

} // namespace

std::vector<double> read_table(const Input& input, std::size_t columns) {
    std::vector<double> numbers;
    std::string_view text = as_text(input.bytes());
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3); // a byte order mark
    int number = 0;
    bool first = true;
    while (!text.empty()) {
        ++number;
        const auto end = text.find_first_of("\r\n");
        std::string_view line = text.substr(0, end);
        const bool pair = end != text.npos && text.substr(end, 2) == "\r\n";
        text.remove_prefix(end == text.npos ? text.size() : end + (pair ? 2 : 1));
        line = skip_parting(line.substr(0, line.find('#')));
        if (line.empty()) continue;
        double value = 0;
        std::string_view peek = line;
        if (first && !take_number(peek, value)) {
            first = false;
            continue;
        }
        first = false;
        for (std::size_t c = 0; c < columns; ++c) {
            if (!take_number(line, value))
                malformed(input.name(), number, "E-CSV",
                          skip_parting(line).empty()
                              ? fmt::format("{} numbers in a row, expected {}", c, columns)
                              : fmt::format("expected a number, found {}",
                                            in_quotes(skip_parting(line).substr(
                                                0, skip_parting(line).find_first_of(",; \t")))));
            if (!std::isfinite(value))
                malformed(input.name(), number, "E-CSV", "a number that is not finite");
            numbers.push_back(value);
        }
    }
    return numbers;
}

std::string csv_number(double x) { return std::isfinite(x) ? spelled(x) : ""; }

std::string csv_text(const std::string& text) {
    if (text.find_first_of(",;\"\r\n") == text.npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

} // namespace facetmill::io
