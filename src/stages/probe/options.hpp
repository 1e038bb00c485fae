#pragma once
// The options of probe, and rows of numbers as users give them: inline, or in a CSV file.

#include "stage/stage.hpp"

namespace facetmill {

/// Rows of N numbers.
template <std::size_t N>
struct Rows {
    std::vector<std::array<double, N>> rows;
    std::string file; ///< read when the stage runs; empty: use the inline rows
};

namespace rows {
bool parse(const Value& value, std::size_t columns, std::vector<double>& numbers, std::string& file,
           Problems& problems);
[[nodiscard]] Json schema(std::size_t columns);
/// Reads the numbers of the file row by row, and records it as an input of the run.
[[nodiscard]] std::vector<double> read(const std::string& file, std::size_t columns, Context& context);
} // namespace rows

template <std::size_t N>
[[nodiscard]] std::vector<std::array<double, N>> rows_of(const std::vector<double>& numbers) {
    std::vector<std::array<double, N>> rows(numbers.size() / N);
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t k = 0; k < N; ++k) rows[i][k] = numbers[N * i + k];
    return rows;
}

template <std::size_t N>
struct OptionType<Rows<N>> {
    static constexpr OptionKind kind = OptionKind::rows;
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

struct ProbeOptions {
    enum class Hits { first, all };

    std::optional<Rows<3>> points;
    std::optional<Rows<6>> segments, rays;
    std::vector<std::string> points_of;
    std::string along;
    bool reverse = false;
    Hits hits = Hits::all;
    std::optional<std::int64_t> face;
    Length tolerance = Length::scene(0);
    std::int64_t max_answers = 1000;
    std::vector<PathText> path;
};

void declare_probe(Declare<ProbeOptions>& d);
/// Checks names of outputs and conflicting options, which the declaration cannot express.
void verify_probe(const ProbeOptions& o, const Value& given, Problems& problems);
/// The files that probe reads and writes.
[[nodiscard]] StageFiles probe_files(const ProbeOptions& o);
bool is_csv(const PathText& path);

} // namespace facetmill
