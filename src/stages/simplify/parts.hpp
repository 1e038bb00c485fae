#pragma once
// The stage simplify for the parts of a scene.

#include "stage/stage.hpp"
#include "stages/simplify/options.hpp"
#include "stages/simplify/report.hpp"

namespace facetmill::simplify_stage {

/// Simplifies the selected parts (geometry/simplify) and reports the results. Coarser levels of detail
/// become separate parts.
[[nodiscard]] Scene simplify_parts(Scene scene, const SimplifyOptions& o, Context& context,
                                   SimplifyReport& report);

/// less: the target is below the current counts. target: the target is a number of faces or vertices, not
/// only an error.
struct AskedFor {
    bool less = true, target = true;
};

/// Warns if a part stopped above its target, needed no collapse, or vanished.
void warn_of_stop(const Part& part, const SimplifyResult& r, AskedFor asked, Context& context);

/// A part that max_quadric_error stopped above its target.
struct Limited {
    std::string part;
    std::size_t before, after; ///< triangles
};
void warn_of_limit(const std::vector<Limited>& limited, const Length& limit, Context& context);

} // namespace facetmill::simplify_stage
