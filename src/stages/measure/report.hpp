#pragma once
// Measures as reports have them. Angles in degrees.

#include "base/json.hpp"
#include "geometry/measure/measure.hpp"

namespace facetmill::report {

Json statistics_json(const Statistics& s,
                     double factor = 1); ///< {count, minimum, maximum, mean, median, deviation}
Json shell_json(const ShellMass& shell); ///< {area, centroid}
/// {volume, mass, centroid, inertia: 3 x 3 about the centroid, principal: {moments, axes}, radii}; null for
/// none.
Json solid_json(const std::optional<SolidMass>& solid, double density);
Json faces_json(const FaceResult& faces);
Json edges_json(const EdgeResult& edges);
Json curvature_json(const CurvatureResult& curvature);

} // namespace facetmill::report
