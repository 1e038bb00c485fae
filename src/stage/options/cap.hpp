#pragma once
// What the stages that cap have in common: the caps' material, and what is said of contours that stay open.

#include "geometry/clip/clip.hpp"
#include "options/declaration.hpp"
#include "stage/context.hpp"

namespace facetmill {

/// Declares `cap` and `cap_material`.
template <class S>
void declare_cap(Declare<S>& d, bool S::*cap, std::string S::*material) {
    d.option("cap", cap,
             "Close what the cut opens with faces in the plane, of a material and a group of their own, "
             "numbered in the face attribute cut_id.")
        .also_called("close capped fill fill_cut");
    d.option("cap_material", material,
             "Name of the caps' material; made when the scene has none of that name.");
}

/// Declares `triangulate`, of a stage that cuts faces.
template <class S>
void declare_triangulate(Declare<S>& d, bool S::*triangulate) {
    d.option("triangulate", triangulate,
             "Cut all faces into triangles; without this, a cut triangle may become a larger face.");
}

/// Where the material of that name is or will be.
Index material_number(const Scene& scene, const std::string& name);

/// Sets what clip or crop needs to cap: the primitive (of the material's number, now or once add_material was
/// called) and the numbers.
template <class Settings>
void set_cap(Settings& settings, const Scene& scene, const std::string& material) {
    settings.cap = true;
    settings.cap_numbers = true;
    settings.cap_primitive = Primitive{material_number(scene, material), {}, {}};
}

/// Appends a material of that name unless the scene has it. Call it only when a cap was made.
void add_material(Scene& scene, const std::string& name);

/// Warns (W-CAP-OPEN) of each contour that the stage did not cap.
void warn_of_open(std::string_view stage, const Part& part, const std::vector<OpenContour>& open,
                  Context& context);

} // namespace facetmill
