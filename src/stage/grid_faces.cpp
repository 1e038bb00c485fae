#include "stage/grid_faces.hpp"

#include "base/text/words.hpp"
#include "geometry/triangulate/crossing_faces.hpp"

namespace facetmill {

void warn_of_crossing_faces_in_grid(const Scene& scene, Context& context) {
    std::size_t crossing = 0;
    for (const Part& part : scene.parts) {
        if (part.mesh.all_triangles() || !context.selects(part, scene)) continue;
        const CrossingFaces faces = fill_crossing_faces(part.mesh);
        crossing += faces.filled + faces.fans;
    }
    if (crossing > 0)
        context.warn("W-FANS",
                     context.name() + ": " + counted(crossing, "face") +
                         " with edges that cross: the pieces of the grid overlap",
                     "use triangulate first");
}

} // namespace facetmill
