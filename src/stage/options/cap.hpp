#pragma once
// Options shared by stages with caps: the caps' material, and the warning about contours that stay open.

#include "geometry/clip/clip.hpp"
#include "options/declaration.hpp"
#include "stage/context.hpp"

namespace facetmill {

/// Declares `cap` and `cap_material`.
template <class S>
void declare_cap(Declare<S>& d, bool S::*cap, std::string S::*material) {
    d.option("cap", cap,
             "Closes the cut with faces in the plane. They get their own material and group, and the face "
             "attribute cut_id numbers them.")
        .also_called("close capped fill fill_cut");
    d.option("cap_material", material,
             "The name of the material of caps. It is created if the scene has none with this name.");
}

/// Declares `triangulate`, for a stage that cuts faces.
template <class S>
void declare_triangulate(Declare<S>& d, bool S::*triangulate) {
    d.option("triangulate", triangulate,
             "Cuts all faces into triangles. Otherwise, a cut triangle may become a larger face.");
}

/// The index of an existing or future material with this name.
[[nodiscard]] Index material_number(const Scene& scene, const std::string& name);

/// Sets the cap settings of clip or crop: the primitive (with the material's number, which add_material may
/// create later) and the numbers.
template <class Settings>
void set_cap(Settings& settings, const Scene& scene, const std::string& material) {
    settings.cap = true;
    settings.cap_numbers = true;
    settings.cap_primitive = Primitive{material_number(scene, material), {}, {}};
}

/// Appends a material with this name unless it exists. Call it only if a cap was made.
void add_material(Scene& scene, const std::string& name);

/// Warns (W-CAP-OPEN) about each contour that the stage did not cap.
void warn_of_open(std::string_view stage, const Part& part, const std::vector<OpenContour>& open,
                  Context& context);

} // namespace facetmill
