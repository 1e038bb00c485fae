#pragma once
// Ambient occlusion: computes the visible share of the sky at each pixel from the depths around it.

#include "geometry/render/shader.hpp"

namespace facetmill {

/// The unoccluded share of each pixel of the canvas, 0 to 1; 1 for empty pixels. Each pixel samples sixteen
/// others on a spiral, whose rotation repeats in blocks of 4 x 4 pixels. The result is averaged over the
/// block at similar depth (M. McGuire, M. Mara and D. Luebke, "Scalable Ambient Obscurance", 2012). radius:
/// the reach of occluders, in samples. coarse: only every second pixel of every second row is evaluated.
[[nodiscard]] std::vector<float> open_sky(const Canvas& canvas, const SceneDrawing& drawing,
                                          const Shader& shader, const View& view, double radius, bool coarse);

} // namespace facetmill
