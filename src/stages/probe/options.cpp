#include "stages/probe/options.hpp"

#include "base/hash.hpp"
#include "io/csv.hpp"
#include "options/lists.hpp"
#include "options/mark_at.hpp"
#include "stage/options/synonyms.hpp"
#include "stage/read_recorded.hpp"

#include <array>
#include <fmt/format.h>

namespace facetmill {

namespace rows {

namespace {

bool refuse(const Value& value, std::size_t columns, Problems& problems) {
    problems.add(
        value.mark, "E-TYPE",
        fmt::format("expected rows of {} numbers or a .csv file, found {}", columns, value.described()),
        columns == 3
            ? "[0, 0, 1], [[0, 0, 1], [1, 2, 3]] or points.csv; on the command line 0,0,1 or '0,0,1; 1,2,3'"
            : "[0, 0, 9, 0, 0, -1] or lines.csv; on the command line 0,0,9,0,0,-1");
    return false;
}

bool parse_row(const Value& value, std::size_t columns, std::vector<double>& numbers, Problems& problems) {
    if (!value.is_list() || value.items.size() != columns) return refuse(value, columns, problems);
    for (const auto& item : value.items) {
        if (item.deferred) {
            numbers.push_back(0);
            continue;
        }
        const auto number = item.as_real();
        if (!number) return refuse(item, columns, problems);
        numbers.push_back(*number);
    }
    return true;
}

} // namespace

bool parse(const Value& value, std::size_t columns, std::vector<double>& numbers, std::string& file,
           Problems& problems) {
    if (value.deferred) return true;
    if (value.is_scalar() && (value.text.find(',') == std::string::npos || value.text.ends_with(".csv"))) {
        file = value.text;
        return !file.empty();
    }
    if (value.is_scalar()) {
        const auto list = list_in_text(value);
        Problems of_row; // a message about the whole text replaces the row's messages
        return (list && parse(*list, columns, numbers, file, of_row)) || refuse(value, columns, problems);
    }
    if (!value.is_list() || value.items.empty()) return refuse(value, columns, problems);
    if (!value.items[0].is_list()) return parse_row(value, columns, numbers, problems);
    bool good = true;
    for (const auto& item : value.items) good &= parse_row(item, columns, numbers, problems);
    return good;
}

Json schema(std::size_t columns) {
    const Json row = {{"type", "array"},
                      {"items", {{"type", Json::array({"number", "string"})}}},
                      {"minItems", columns},
                      {"maxItems", columns}};
    return {{"anyOf",
             Json::array({row, {{"type", "array"}, {"items", row}, {"minItems", 1}}, {{"type", "string"}}})}};
}

std::vector<double> read(const std::string& file, std::size_t columns, Context& context) {
    const io::Input input = io::Input::open(context.places().input(file));
    record_input(context, input.name(), input.stored().size(), sha256(input.stored()));
    constexpr std::array<std::string_view, 3> names{"x", "y", "z"};
    return io::read_table(input, columns,
                          columns == 3 ? std::span<const std::string_view>(names)
                                       : std::span<const std::string_view>());
}

} // namespace rows

void declare_probe(Declare<ProbeOptions>& d) {
    d.option("points", &ProbeOptions::points,
             "The points to query: rows of x, y, z in world space, or a CSV file with such rows. Columns may "
             "have any order if a header names them x, y and z. On the command line: '0,0,0; 1,2,3'.")
        .primary();
    d.option("points_of", &ProbeOptions::points_of,
             "Parts, by name or glob, whose vertices are the points. The other parts are the surface.");
    d.option("segments", &ProbeOptions::segments,
             "Rows of six numbers for the two ends (x, y, z, x, y, z), or a CSV file.");
    d.option("rays", &ProbeOptions::rays,
             "Rows of six numbers for origin and direction (x, y, z, x, y, z), or a CSV file.");
    d.option("along", &ProbeOptions::along,
             "An attribute with three components. A ray starts at every vertex in this direction. A part "
             "without NORMAL uses the normals of its faces. The faces at the vertex are ignored.");
    d.option("reverse", &ProbeOptions::reverse,
             "Reverses the rays of along. With NORMAL, they run inward and measure the wall thickness.");
    d.choice<ProbeOptions::Hits>("hits", &ProbeOptions::hits,
                                 {{"all", ProbeOptions::Hits::all, "all hits of a segment or ray, in order"},
                                  {"first", ProbeOptions::Hits::first, "only the first hit"}},
                                 "The hits of segments and rays to report. along always reports the first.");
    d.option("face", &ProbeOptions::face,
             "Tests segments and rays only against the face with this number, counted through all parts. "
             "Each result is hit, parallel, in plane, outside segment or outside facet.")
        .at_least(0);
    d.option("tolerance", &ProbeOptions::tolerance,
             "Points within this distance count as on the surface. 0 means exactly on it.")
        .at_least(0);
    d.option("max_answers", &ProbeOptions::max_answers,
             "The maximum number of answers in the report. Files contain all answers.")
        .between(0, 1e6);
    d.option("path", &ProbeOptions::path,
             "The .csv or .json file for all answers, or a list of files. - writes JSON to standard output.")
        .also_called(path_synonyms);
    d.exactly_one({"points", "points_of", "segments", "rays", "along"});
}

bool is_csv(const PathText& path) { return path.text.ends_with(".csv"); }

StageFiles probe_files(const ProbeOptions& o) {
    StageFiles files{{}, o.path};
    if (o.points && !o.points->file.empty()) files.inputs.push_back({o.points->file});
    for (const auto* lines : {&o.segments, &o.rays})
        if (*lines && !(*lines)->file.empty()) files.inputs.push_back({(*lines)->file});
    return files;
}

void verify_probe(const ProbeOptions& o, const Value& given, Problems& problems) {
    for (const auto& path : o.path)
        if (path.text != "-" && !is_csv(path) && !path.text.ends_with(".json"))
            problems.add(given.mark, "E-FORMAT", fmt::format("probe cannot write '{}'", path.text),
                         "use a name that ends in .csv or .json");
    if (given.find("reverse") && o.along.empty())
        add_refusal(needs("reverse", "along"), "probe", given, problems);
    if (o.segments || o.rays) return;
    if (given.find("hits")) add_refusal(needs("hits", "segments or rays"), "probe", given, problems);
    if (o.face) add_refusal(needs("face", "segments or rays"), "probe", given, problems);
}

} // namespace facetmill
