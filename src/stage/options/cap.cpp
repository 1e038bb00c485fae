#include "stage/options/cap.hpp"

#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "mesh/placement.hpp"

#include <fmt/format.h>

namespace facetmill {

Index material_number(const Scene& scene, const std::string& name) {
    Index i = 0;
    while (i < scene.materials.size() && scene.materials[i].name != name) ++i;
    return i;
}

void add_material(Scene& scene, const std::string& name) {
    if (material_number(scene, name) == scene.materials.size()) scene.materials.emplace_back().name = name;
}

void warn_of_open(std::string_view stage, const Part& part, const std::vector<OpenContour>& open,
                  Context& context) {
    for (const OpenContour& contour : open) {
        const Vec3 at = in_world(part, contour.at);
        context.warn("W-CAP-OPEN",
                     fmt::format("{}: a contour of {} of part '{}' is open and was not capped; it ends at "
                                 "({})",
                                 stage, counted(contour.edges, "edge"), part.name, readable(at, ", ")),
                     "the part has a hole where the plane cuts it: fill it first (clean: {holes: minimal})");
    }
}

} // namespace facetmill
