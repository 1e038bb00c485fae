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
             "The points to query: rows of x, y, z in world space, or a CSV file with such rows; columns "
             "named x, y, z in its header are used, wherever they are. On the command line '0,0,0; 1,2,3'.")
        .primary();
    d.option("points_of", &ProbeOptions::points_of,
             "Parts, by name or glob, whose vertices are the points; the other parts are the surface.");
    d.option("segments", &ProbeOptions::segments,
             "Rows of six numbers, from x, y, z to x, y, z, or a CSV file.");
    d.option("rays", &ProbeOptions::rays,
             "Rows of six numbers, an origin x, y, z and a direction x, y, z, or a CSV file.");
    d.option("along", &ProbeOptions::along,
             "An attribute of three components: a ray is cast from every vertex along it. Where a part has "
             "no NORMAL, the normals of the faces are used. The faces at the vertex are ignored.");
    d.option("reverse", &ProbeOptions::reverse,
             "Reverses the rays of along; with NORMAL they run inward and measure the wall thickness.");
    d.choice<ProbeOptions::Hits>(
        "hits", &ProbeOptions::hits,
        {{"all", ProbeOptions::Hits::all, "every face that a segment or ray hits, in order"},
         {"first", ProbeOptions::Hits::first, "only the first one"}},
        "Which hits of segments and rays are reported; along always reports the first.");
    d.option("face", &ProbeOptions::face,
             "Tests segments and rays against this face only (a number; faces are numbered through all "
             "parts). Each is classified as hit, parallel, in plane, outside segment or outside facet.")
        .at_least(0);
    d.option("tolerance", &ProbeOptions::tolerance,
             "A point within this distance counts as on the surface (a length); 0: exactly on it.")
        .at_least(0);
    d.option("max_answers", &ProbeOptions::max_answers,
             "The maximum number of answers in the report (a count); files contain all of them.")
        .between(0, 1e6);
    d.option(
         "path", &ProbeOptions::path,
         "The file to write all answers to, or a list of files, .csv or .json; - is JSON on standard output.")
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
                         "a name that ends in .csv or .json");
    if (given.find("reverse") && o.along.empty())
        add_refusal(Refusal{"reverse", "'reverse' goes with along"}, "probe", given, problems);
    if (o.segments || o.rays) return;
    if (given.find("hits"))
        add_refusal(Refusal{"hits", "'hits' goes with segments or rays"}, "probe", given, problems);
    if (o.face) add_refusal(Refusal{"face", "'face' goes with segments or rays"}, "probe", given, problems);
}

} // namespace facetmill
