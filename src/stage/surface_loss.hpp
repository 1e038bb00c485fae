#pragma once
// Checks that no stage loses surface without a warning.

#include "geometry/edit/moved.hpp"
#include "mesh/scene.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace facetmill {

class Context;

/// How much of a part's surface a stage may remove without a warning.
enum class MayLose {
    tenth, ///< a tenth of the area: the stage preserves the surface
    half,  ///< half of the area: the stage changes the shape
    area,  ///< any area, but not every face: the stage cuts, scales or replaces on request
    all,   ///< everything: the stage itself warns if nothing is left
};

/// The surface of a part in world space, including all instances in a glTF document
/// (EXT_mesh_gpu_instancing).
struct PartSurface {
    std::string name;
    std::size_t faces = 0;
    double area = 0;
    std::optional<SurfaceSize> size{}; ///< size of the mesh with the part's transform, if a stage measured it
};
/// The surface of each part. O(corners), parallel. For instances with non-uniform scale, the area is
/// estimated, in the same way before and after a stage. sizes: [parts] known sizes, or empty.
[[nodiscard]] std::vector<PartSurface>
surfaces_of_parts(const Scene& scene, std::span<const std::optional<SurfaceSize>> sizes = {});

/// Warns (W-SURFACE-LOST) about a larger loss than allowed: all faces, or too much area. It compares part by
/// part if the parts are the same before and after, otherwise the whole scene. Infinite and zero areas are
/// skipped.
void warn_of_lost_surface(const std::vector<PartSurface>& before, const std::vector<PartSurface>& after,
                          MayLose may_lose, Context& context);

} // namespace facetmill
