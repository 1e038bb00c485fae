#pragma once
// The options of measure.

#include "stage/stage.hpp"

namespace facetmill::measure_stage {

struct MeasureOptions {
    double density = 1;
    Angle feature_angle = Angle::degrees(30);
    bool areas = false, curvature = false;
    std::vector<PathText> path;
};

void declare_measure(Declare<MeasureOptions>& d);
/// What the declaration cannot say: the formats of the files.
void verify_measure(const MeasureOptions& o, const Value& given, Problems& problems);
StageFiles files_of_measure(const MeasureOptions& o);

/// Whether the file gets a line for every face, rather than all results as JSON.
bool lists_faces(const PathText& path);

} // namespace facetmill::measure_stage
