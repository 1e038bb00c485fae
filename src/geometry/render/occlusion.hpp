#pragma once
// How much of the sky is seen from each pixel, from the depths around it.

#include "geometry/render/shader.hpp"

namespace facetmill {

/// 0 to 1 for each pixel of the canvas, 1 where nothing is. Each pixel looks at sixteen others on a spiral
/// that turns from pixel to pixel in a pattern of four by four, and is mixed with those of the pattern around
/// it that lie as deep (M. McGuire, M. Mara and D. Luebke, "Scalable Ambient Obscurance", 2012). radius: how
/// far occluders matter, in samples. coarse: only every second pixel of every second row looks.
[[nodiscard]] std::vector<float> open_sky(const Canvas& canvas, const SceneDrawing& drawing,
                                          const Shader& shader, const View& view, double radius, bool coarse);

} // namespace facetmill
