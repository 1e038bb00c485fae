#include "stages/measure/options.hpp"

#include "stages/measure/face_table.hpp"

#include <fmt/format.h>

namespace facetmill::measure_stage {

void declare_measure(Declare<MeasureOptions>& d) {
    d.option("density", &MeasureOptions::density,
             "The mass per cubic scene unit, which scales mass and inertia.")
        .above(0);
    d.option("feature_angle", &MeasureOptions::feature_angle,
             "Edges whose dihedral angle is larger than this count as feature edges (an angle between the "
             "normals of the two faces).")
        .between(0, 180);
    d.option("areas", &MeasureOptions::areas,
             "Writes the area of every face, in square scene units, as face attribute area.");
    d.option(
        "curvature", &MeasureOptions::curvature,
        "Writes the curvature at every vertex as vertex attributes gaussian_curvature and mean_curvature "
        "(per square scene unit and per scene unit; 0 where there is none).");
    d.option("path", &MeasureOptions::path,
             "The file to write, or a list of files; the suffix decides the format. .json gets all results, "
             ".csv one line per face; - is JSON on standard output. The columns of the table: " +
                 face_table_help() + ".");
}

void verify_measure(const MeasureOptions& o, const Value& given, Problems& problems) {
    for (const auto& path : o.path)
        if (path.text != "-" && !lists_faces(path) && !path.text.ends_with(".json"))
            problems.add(given.mark, "E-FORMAT", fmt::format("measure cannot write '{}'", path.text),
                         "a name that ends in .json or .csv");
}

StageFiles files_of_measure(const MeasureOptions& o) { return {{}, o.path}; }

bool lists_faces(const PathText& path) { return path.text.ends_with(".csv"); }

} // namespace facetmill::measure_stage
