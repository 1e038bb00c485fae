#pragma once
// Which files a plan would write, where only its stages know: textures that become WebP where that is
// smaller, images that nothing uses any more.

#include "pipeline/plan.hpp"

namespace facetmill::pipeline {

/// read_headers, with the files that are written beside outputs as a run would write them. Where stages
/// change images (Headers::images_change) those stages that matter run, which takes as long as they take, and
/// nothing is written; what cannot run, lacks an input or is larger than memory leaves the names that there
/// would be without those stages.
Headers rehearsed_headers(const Plan& plan);

} // namespace facetmill::pipeline
