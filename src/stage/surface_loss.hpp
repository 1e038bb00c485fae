#pragma once
// Promise 3 for the surface itself: no stage loses it in silence.

#include "geometry/edit/moved.hpp"
#include "mesh/scene.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace facetmill {

class Context;

/// How much of a part's surface a stage may take without a word.
enum class MayLose {
    tenth, ///< a tenth of the area: it keeps the surface
    half,  ///< half of the area: it changes the shape
    area,  ///< any area: it cuts off, scales or replaces, as it was asked to; but not every face
    all,   ///< it says itself when nothing is left
};

/// What there is of the surface of a part, in world space, at all places that a glTF document has it at
/// (EXT_mesh_gpu_instancing).
struct PartSurface {
    std::string name;
    std::size_t faces = 0;
    double area = 0;
    std::optional<SurfaceSize> size{}; ///< of the mesh at the part's transform, where a stage measured it
};
/// Of each part. O(corners), parallel. Of instances that are scaled by different factors along the axes the
/// area is estimated, alike before a stage and behind it. sizes: [parts] those that are known, or empty.
std::vector<PartSurface> surfaces_of_parts(const Scene& scene,
                                           std::span<const std::optional<SurfaceSize>> sizes = {});

/// Warns (W-SURFACE-LOST) of what a stage took beyond that: all faces, or more of the area. Part by part as
/// long as these are the same before and after; else of the scene as a whole. Areas that are not finite or 0
/// are not compared.
void warn_of_lost_surface(const std::vector<PartSurface>& before, const std::vector<PartSurface>& after,
                          MayLose may_lose, Context& context);

} // namespace facetmill
