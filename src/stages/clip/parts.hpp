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

/// Clips the parts selected by the cutter's planes; with Keep::both the back of each comes behind it. Counts
/// go into the stage's result. Warns of open contours (W-CAP-OPEN), of parts that no plane met (W-CLIP-ALL)
/// and of which nothing is left (W-CLIP-NOTHING).
void clip_parts(Scene& scene, const Cutter& cutter, const PartsToClip& how, Context& context);

} // namespace facetmill
