#pragma once
// Two scenes seen by one camera, for the page of a comparison.

#include "base/error.hpp"
#include "base/json.hpp"
#include "mesh/scene.hpp"
#include "report/views.hpp"

namespace facetmill::report {

/// PNG images in base64, and distances both ways.
struct ComparisonPictures {
    std::string a, b;
    /// From the first scene to the second: removed geometry. Its diagonal is the first's, like backward's.
    std::optional<DeviationView> forward;
    std::optional<DeviationView> backward; ///< from the second to the first: new geometry
    Json view;                             ///< both, to be turned (report/viewer.hpp)
    std::vector<Diagnostic> not_drawn;     ///< textures that all of these do without, and why
};

/// Both by the camera of the first scene, unless the second goes beyond it; then by one that sees both. No
/// distances where a scene is empty, or nothing is off the other. Names: of the files, as they were given.
/// O((vertices + faces) log n).
ComparisonPictures comparison_pictures(const Scene& a, const Scene& b, const std::string& name_a,
                                       const std::string& name_b);

} // namespace facetmill::report
