#pragma once
// Rows of numbers as users give them: written out, or in a CSV file.

#include "options/declaration.hpp"
#include "stage/context.hpp"

namespace facetmill {

/// Rows of N numbers.
template <std::size_t N>
struct Rows {
    std::vector<std::array<double, N>> rows;
    std::string file; ///< read when the stage runs; empty: rows are all
};

namespace rows {
bool parse(const Value& value, std::size_t columns, std::vector<double>& numbers, std::string& file,
           Problems& problems);
Json schema(std::size_t columns);
/// The numbers of the file, row by row; it is an input of the run.
std::vector<double> read(const std::string& file, std::size_t columns, Context& context);
} // namespace rows

template <std::size_t N>
std::vector<std::array<double, N>> rows_of(const std::vector<double>& numbers) {
    std::vector<std::array<double, N>> rows(numbers.size() / N);
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t k = 0; k < N; ++k) rows[i][k] = numbers[N * i + k];
    return rows;
}

template <std::size_t N>
struct OptionType<Rows<N>> {
    static constexpr const char* name = "rows";
    static constexpr Dimension dimension = Dimension::none;
    static bool parse(const Value& value, Rows<N>& out, Problems& problems) {
        std::vector<double> numbers;
        if (!rows::parse(value, N, numbers, out.file, problems)) return false;
        out.rows = rows_of<N>(numbers);
        return true;
    }
    static std::string print(const Rows<N>&) { return ""; }
    static Json schema() { return rows::schema(N); }
    static std::optional<double> magnitude(const Rows<N>&) { return {}; }
};

} // namespace facetmill
