#pragma once
// Pictures of two scenes by the same camera, for the page of a comparison.

#include "base/error.hpp"
#include "base/json.hpp"
#include "mesh/scene.hpp"
#include "report/views.hpp"

namespace facetmill::report {

/// PNG images in base64, and distances in both directions.
struct ComparisonPictures {
    std::string a, b;
    /// Distances of the first scene from the second: removed geometry. The diagonal is the first scene's, as
    /// for backward.
    std::optional<DeviationView> forward;
    std::optional<DeviationView> backward; ///< distances of the second scene from the first: added geometry
    Json view;                             ///< rotatable view of both (report/viewer.hpp)
    std::vector<Diagnostic> not_drawn;     ///< textures missing in all of these, with reasons
};

/// Both use the camera of the first scene, or a camera that shows both if the second is larger. No distances
/// if a scene is empty, or if nothing differs. Names: the names of the files as given. O((vertices + faces)
/// log n).
[[nodiscard]] ComparisonPictures comparison_pictures(const Scene& a, const Scene& b,
                                                     const std::string& name_a, const std::string& name_b);

} // namespace facetmill::report
