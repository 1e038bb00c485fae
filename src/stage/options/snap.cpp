#include "stage/options/snap.hpp"

#include "base/text/words.hpp"
#include "geometry/cut/cut.hpp"
#include "mesh/float32_ulp.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

std::optional<double> seen_rounding(const Mesh& mesh) {
    constexpr double share_that_is_seen = 1e-5; // times the diagonal: less than a pixel of a large picture
    const Box bounds = mesh.bounds();
    const double apart = float32_ulp(bounds);
    if (apart <= share_that_is_seen * bounds.diagonal()) return {};
    const auto floats = std::count_if(mesh.positions.begin(), mesh.positions.end(),
                                      [](const Vec3& p) { return is_float32(p); });
    if (2 * static_cast<std::size_t>(floats) < mesh.positions.size()) return {};
    return apart;
}

void warn_of_snapping(const std::string& part, std::size_t vertices, double apart, const std::string& what,
                      Context& context) {
    context.warn("W-SNAPPED",
                 fmt::format("{} of part '{}' {} as on {} though up to {:.2g} away, because 32-bit floats "
                             "are that far apart at this distance from the origin",
                             counted(vertices, "vertex", "vertices"), part,
                             vertices == 1 ? "counts" : "count", what, apart),
                 "use snap: 0 to take positions as they are, if they were never 32-bit floats");
}

} // namespace facetmill
