#pragma once
// The contents of a failing check's picture.

#include "geometry/render/render.hpp"
#include "report/record.hpp"

namespace facetmill::report {

/// The face attribute that marks the faces of a check with 1, others with 0.
inline constexpr const char* failing_attribute = "failing";

/// The scene with that attribute. The check must have evidence.
[[nodiscard]] Scene with_failing_faces(const Scene& scene, const Check& check);

struct CloseView {
    Scene scene;
    PictureSettings settings; ///< the given settings, magnified and rotated
};
/// Magnifies the first location of the check. The first face of the check is seen from the front, and covers
/// a sixth of the picture; faces in front of it are removed. marked: result of with_failing_faces. O(n).
[[nodiscard]] CloseView close_view(const Scene& marked, const Check& check, PictureSettings settings);

} // namespace facetmill::report
