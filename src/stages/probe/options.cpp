#include "stages/probe/options.hpp"

#include <fmt/format.h>

namespace facetmill {

void declare_probe(Declare<ProbeOptions>& d) {
    d.option("points", &ProbeOptions::points,
             "Points to ask about: rows of x, y, z in world space, or a CSV file with such rows; columns "
             "that its "
             "heading calls x, y, z are read wherever they stand. In one line '0,0,0; 1,2,3'.")
        .primary();
    d.option("points_of", &ProbeOptions::points_of,
             "Parts, by name or glob, whose vertices are the points; the other parts are the surface.");
    d.option("segments", &ProbeOptions::segments,
             "Rows of six numbers, from x, y, z to x, y, z; or a CSV file.");
    d.option("rays", &ProbeOptions::rays,
             "Rows of six numbers, a start x, y, z and a direction x, y, z; or a CSV file.");
    d.option(
        "along", &ProbeOptions::along,
        "An attribute of three numbers: a ray from every vertex along it. NORMAL, where a part has none, is "
        "that of the faces. The faces at the vertex do not count.");
    d.option("reverse", &ProbeOptions::reverse,
             "Rays of along run the other way; along NORMAL that is inward, and measures the wall.");
    d.choice<ProbeOptions::Hits>(
        "hits", &ProbeOptions::hits,
        {{"all", ProbeOptions::Hits::all, "every face that a segment or ray meets, in order"},
         {"first", ProbeOptions::Hits::first, "the first one"}},
        "What is asked of segments and rays; along always takes the first.");
    d.option("face", &ProbeOptions::face,
             "Segments and rays are held against this face alone (a number, parts counted through), and each "
             "is told as "
             "hit, parallel, in plane, outside segment or outside facet.")
        .at_least(0);
    d.option("on", &ProbeOptions::on,
             "Up to this distance a point lies on the surface (a length). 0: exactly on it.")
        .at_least(0);
    d.option("list", &ProbeOptions::list, "How many answers the report lists (a count); files hold all.")
        .between(0, 1e6);
    d.option("to", &ProbeOptions::to,
             "Writes all answers there: .csv or .json; - is JSON on standard output.");
    d.exactly_one({"points", "points_of", "segments", "rays", "along"});
}

bool is_csv(const PathText& path) { return path.text.ends_with(".csv"); }

StageFiles probe_files(const ProbeOptions& o) {
    StageFiles files{{}, o.to};
    if (o.points && !o.points->file.empty()) files.inputs.push_back({o.points->file});
    for (const auto* lines : {&o.segments, &o.rays})
        if (*lines && !(*lines)->file.empty()) files.inputs.push_back({(*lines)->file});
    return files;
}

void verify_probe(const ProbeOptions& o, const Value& given, Problems& problems) {
    for (const auto& path : o.to)
        if (path.text != "-" && !is_csv(path) && !path.text.ends_with(".json"))
            problems.add(given.mark, "E-FORMAT", fmt::format("probe cannot write '{}'", path.text),
                         "a name that ends in .csv or .json");
    if (given.find("reverse") && o.along.empty())
        problems.add(given.mark, "E-CONFLICT", "'reverse' goes with along");
    if (given.find("hits") && !o.segments && !o.rays)
        problems.add(given.mark, "E-CONFLICT", "'hits' goes with segments or rays");
    if (o.face && !o.segments && !o.rays)
        problems.add(given.mark, "E-CONFLICT", "'face' goes with segments or rays");
}

} // namespace facetmill
