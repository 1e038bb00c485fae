#include "stage/crossing_faces.hpp"

#include "base/text/words.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "stage/context.hpp"

#include <fmt/format.h>

namespace facetmill {

void prepare_crossing_faces(CrossingFacePolicy policy, Scene& scene, Context& context) {
    if (policy == CrossingFacePolicy::name) name_fans(scene, context);
    if (policy != CrossingFacePolicy::fill) return;
    FanCounts all;
    for (Part& part : scene.parts) {
        if (part.mesh.all_triangles() || !context.selects(part, scene)) continue;
        CrossingFaces faces = fill_crossing_faces(part.mesh);
        all.fans += faces.fans;
        all.overlapping += faces.overlapping;
        if (!faces.mesh) continue;
        context.attribute_changes(part, faces.changes);
        part.mesh = std::move(*faces.mesh);
    }
    warn_of_fans(all, context);
}

void name_fans(const Scene& scene, Context& context) {
    FanCounts all;
    for (const Part& part : scene.parts)
        if (context.selects(part, scene)) all.fans += count_fans(part.mesh);
    warn_of_fans(all, context);
}

void warn_of_fans(const FanCounts& faces, Context& context) {
    if (faces.fans > 0)
        context.warn(
            "W-FANS",
            fmt::format(
                "faces without area, and non-planar faces that intersect themselves, count as fans of "
                "triangles, which may overlap: {}",
                faces.fans));
    if (faces.overlapping > 0)
        context.warn("W-FANS", fmt::format("{} {} around points several times, so their triangles overlap: "
                                           "otherwise the surface would be open",
                                           counted(faces.overlapping, "face"),
                                           faces.overlapping == 1 ? "winds" : "wind"));
}

} // namespace facetmill
