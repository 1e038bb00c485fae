#include "stages/measure/options.hpp"

#include <fmt/format.h>

namespace facetmill {

void declare_measure(Declare<MeasureOptions>& d) {
    d.option("density", &MeasureOptions::density,
             "Mass per cubic scene unit; mass and inertia are multiplied by it.")
        .above(0);
    d.option("sharp", &MeasureOptions::sharp, "Edges that turn by more than this count as sharp.")
        .between(0, 180);
    d.option("areas", &MeasureOptions::areas,
             "Writes the area of every face, in square scene units, as face attribute area.");
    d.option(
        "curvature", &MeasureOptions::curvature,
        "Writes the curvature at every vertex as vertex attributes gaussian_curvature and mean_curvature "
        "(per square scene unit and per scene unit; 0 where there is none).");
    d.option(
        "to", &MeasureOptions::to,
        "Writes the results there: .json all of them, .csv one line per face (part, face, corners, area, "
        "centroid, unit normal, farthest corner from its plane); - is JSON on standard output.");
}

void verify_measure(const MeasureOptions& o, const Value& given, Problems& problems) {
    for (const auto& path : o.to)
        if (path.text != "-" && !lists_faces(path) && !path.text.ends_with(".json"))
            problems.add(given.mark, "E-FORMAT", fmt::format("measure cannot write '{}'", path.text),
                         "a name that ends in .json or .csv");
}

StageFiles files_of_measure(const MeasureOptions& o) { return {{}, o.to}; }

bool lists_faces(const PathText& path) { return path.text.ends_with(".csv"); }

} // namespace facetmill
