#include "stage/crossing_faces.hpp"

#include "geometry/triangulate/crossing_faces.hpp"

#include <fmt/format.h>

namespace facetmill {

FilledFaces fill_crossing_faces(Scene& scene, Context& context) {
    FilledFaces all;
    for (Part& part : scene.parts) {
        if (part.mesh.all_triangles() || !context.selects(part, scene)) continue;
        if (auto filled = fill_crossing_faces(part.mesh)) {
            context.attribute_changes(part, filled->changes);
            all.overlapping += filled->overlapping;
            part.mesh = std::move(filled->mesh);
        }
        all.fans += count_crossing_faces(part.mesh);
    }
    return all;
}

void warn_of_fans(const FilledFaces& faces, Context& context) {
    if (faces.fans > 0)
        context.warn(
            "W-FANS",
            fmt::format("{} faces that have no area, or intersect themselves in no plane, were cut as "
                        "fans, whose triangles may overlap",
                        faces.fans));
    if (faces.overlapping > 0)
        context.warn(
            "W-FANS",
            fmt::format("{} faces wind around points several times, and their triangles overlap there: "
                        "faces beside them would be open otherwise",
                        faces.overlapping));
}

} // namespace facetmill
