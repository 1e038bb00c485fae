#include "geometry/section/stack.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"

#include <fmt/format.h>

namespace facetmill {

Extent extent_along(const Plane& plane, const Mesh& mesh, const Transform& to_world) {
    const double scale = length(plane.normal);
    return parallel_reduce(
        mesh.positions.size(), Extent{},
        [&](std::size_t begin, std::size_t end) {
            Extent e;
            for (std::size_t i = begin; i < end; ++i) {
                const double h = side(plane, to_world.point(mesh.positions[i])) / scale;
                e.add({h, h});
            }
            return e;
        },
        [](Extent a, const Extent& b) {
            a.add(b);
            return a;
        });
}

Stack stack_of(const Extent& extent, std::optional<double> spacing, std::optional<std::int64_t> count) {
    Stack stack{{}, spacing.value_or(0)};
    double first = 0, planes = count ? static_cast<double>(*count) : 0;
    if (!(extent.low <= extent.high)) {
        planes = spacing ? planes : 0;
    } else if (!count) {
        first = std::ceil(extent.low / stack.spacing);
        planes = std::floor(extent.high / stack.spacing) - first + 1;
        first *= stack.spacing;
    } else if (!spacing) {
        stack.spacing = (extent.high - extent.low) / planes;
        first = extent.low + stack.spacing / 2;
        if (!(stack.spacing > 0)) planes = 0;
    }
    if (planes > static_cast<double>(most_planes))
        throw Error(
            ErrorKind::limit, "E-SECTION",
            fmt::format("the stack would have {:.0f} planes, and at most {} are cut", planes, most_planes),
            "choose a larger spacing");
    for (std::int64_t i = 0; static_cast<double>(i) < planes; ++i)
        stack.heights.push_back(first + static_cast<double>(i) * stack.spacing);
    return stack;
}

} // namespace facetmill
