#pragma once
// Pictures of two scenes from the same camera, for the page of a comparison.

#include "base/error.hpp"
#include "base/json.hpp"
#include "mesh/scene.hpp"
#include "report/views.hpp"

namespace facetmill::report {

/// PNG images in base64, and distances in both directions.
struct ComparisonPictures {
    std::string a, b;
    /// From the first scene to the second: removed geometry. Its diagonal is the first scene's, as in
    /// backward.
    std::optional<DeviationView> forward;
    std::optional<DeviationView> backward; ///< from the second to the first: added geometry
    Json view;                             ///< both scenes, for interactive rotation (report/viewer.hpp)
    std::vector<Diagnostic> not_drawn;     ///< textures missing from all pictures, with reasons
};

/// Uses the camera of the first scene, or a camera that shows both if the second extends beyond it. No
/// distances if a scene is empty or both agree. Names: of the files as given. O((vertices + faces) log n).
ComparisonPictures comparison_pictures(const Scene& a, const Scene& b, const std::string& name_a,
                                       const std::string& name_b);

} // namespace facetmill::report
