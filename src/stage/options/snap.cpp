#include "stage/options/snap.hpp"

#include "base/text/words.hpp"

#include <fmt/format.h>

namespace facetmill {

void warn_of_snapping(const std::string& part, const Snapped& snapped, const std::string& what,
                      Context& context) {
    constexpr double share_that_is_seen = 1e-5; // of the diagonal: less than a pixel of a large picture
    if (snapped.vertices == 0 || snapped.by <= share_that_is_seen * snapped.size) return;
    context.warn("W-SNAPPED",
                 fmt::format("{} of part '{}' {} as on {} though up to {:.2g} away, because 32-bit floats "
                             "are rounded by that much at this distance from the origin",
                             counted(snapped.vertices, "vertex", "vertices"), part,
                             snapped.vertices == 1 ? "counts" : "count", what, snapped.by),
                 "use snap: 0 to keep positions exact");
}

} // namespace facetmill
