#pragma once
// Mass properties as text for robot simulators.

#include "stages/measure/report.hpp"

namespace facetmill::measure_stage {

enum class RobotFormat { none, urdf, mjcf };
/// The format by the suffix of the file: .urdf, or .mjcf and .xml.
[[nodiscard]] RobotFormat robot_format(const PathText& path);

/// A link (URDF) or body (MJCF) for each part, with its mass, its centre of mass and its inertia about this
/// centre along the axes of the scene. Lengths are in metres. Throws a stage error (E-MASS) for a part
/// without a positive mass.
[[nodiscard]] std::string robot_text(RobotFormat format, const MeasureReport& report);

} // namespace facetmill::measure_stage
