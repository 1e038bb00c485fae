#pragma once
// What the picture of a failing check shows.

#include "geometry/render/render.hpp"
#include "report/record.hpp"

namespace facetmill::report {

/// The face attribute that tells the faces that a check names, 1, from the others, 0.
inline constexpr const char* failing_attribute = "failing";

/// The scene with that attribute. The check has evidence.
Scene with_failing_faces(const Scene& scene, const Check& check);

struct CloseView {
    Scene scene;
    PictureSettings settings; ///< as given, magnified and turned
};
/// The first place that the check names, magnified; the first face that it names is seen from its front,
/// takes a sixth of the picture, and what would hide it is not in the scene. marked: with_failing_faces.
/// O(n).
CloseView close_view(const Scene& marked, const Check& check, PictureSettings settings);

} // namespace facetmill::report
