#pragma once
// Two scenes seen by one camera, for the page of a comparison.

#include "base/error.hpp"
#include "base/json.hpp"
#include "mesh/scene.hpp"
#include "report/views.hpp"

namespace facetmill::report {

/// PNG images in base64, and distances there and back.
struct ComparisonPictures {
    std::string a, b;
    /// Of the first scene from the second: what is gone. Its diagonal is that of the first, as backward's.
    std::optional<DeviationView> forward;
    std::optional<DeviationView> backward; ///< of the second from the first: what is new
    Json view;                             ///< both, to be turned (report/viewer.hpp)
    std::vector<Diagnostic> not_drawn;     ///< textures that all of these do without, and why
};

/// Both by the camera of the first scene, unless the second goes beyond it; then by one that sees both. No
/// distances where a scene is empty, or nothing is off the other. Names: of the files, as they were given.
/// O((vertices + faces) log n).
ComparisonPictures comparison_pictures(const Scene& a, const Scene& b, const std::string& name_a,
                                       const std::string& name_b);

} // namespace facetmill::report
