#pragma once
// Clips the parts of a scene.

#include "stage/options/cap.hpp"
#include "stages/clip/cutter.hpp"

namespace facetmill {

struct PartsToClip {
    ClipSettings settings; ///< the same for all; planes, memory and the caps' primitive are set part by part
    std::string cap_material;
    const char *front = ".front", *back = ".back"; ///< added to the names of both sides
};

struct ClipReport {
    std::optional<std::vector<Plane>> planes; ///< in the world
    std::size_t cut_faces = 0, cap_faces = 0, open_contours = 0, on_plane = 0, snapped = 0, remembered = 0;
};

/// Clips the parts selected by the cutter's planes; with Keep::both the back of each comes behind it. Warns
/// of open contours (W-CAP-OPEN), of parts that no plane met (W-CLIP-ALL) and of which nothing is left
/// (W-CLIP-NOTHING).
ClipReport clip_parts(Scene& scene, const Cutter& cutter, const PartsToClip& how, Context& context);

} // namespace facetmill
