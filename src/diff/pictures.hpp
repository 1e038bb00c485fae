#pragma once
// Two scenes seen by one camera, for the page of a comparison.

#include "base/json.hpp"
#include "geometry/render/render.hpp"

namespace facetmill::report {

/// PNG images in base64.
struct ComparisonPictures {
    std::string a, b;
    std::string
        distance; ///< the second scene, its vertices coloured by their signed distances from the first
    Json view;    ///< both, to be turned (report/viewer.hpp)
};

/// Both by the camera of the first scene, unless the second goes beyond it; then by one that sees both. A
/// distance is positive outside: on the side to which the nearest face of the first looks. Empty where a
/// scene has no faces. O((vertices + faces) log n).
ComparisonPictures comparison_pictures(const Scene& a, const Scene& b, const std::string& name_a,
                                       const std::string& name_b);

} // namespace facetmill::report
