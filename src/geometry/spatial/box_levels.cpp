#include "geometry/spatial/box_levels.hpp"

#include "parallel/storage.hpp"

#include <algorithm>

namespace facetmill {

void BoxLevels::Node::clear(std::size_t slot) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        min[axis][slot] = HUGE_VALF;
        max[axis][slot] = -HUGE_VALF;
    }
}

void BoxLevels::Node::set(std::size_t slot, const Vec3& low, const Vec3& high) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        min[axis][slot] = rounded_down(low[axis]);
        max[axis][slot] = rounded_up(high[axis]);
    }
}

void BoxLevels::Node::set(std::size_t slot, const Node& child) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        min[axis][slot] = *std::min_element(child.min[axis], child.min[axis] + 4);
        max[axis][slot] = *std::max_element(child.max[axis], child.max[axis] + 4);
    }
}

void BoxLevels::set_frame(const Box& all) {
    middle = all.min * 0.5 + all.max * 0.5; // halved first: the sum of huge coordinates would overflow
    const Vec3 half = all.max - middle;
    const double reach = std::max({half.x, half.y, half.z});
    if (reach > 0 && std::isfinite(reach))
        scale = std::ldexp(1.0, std::min(-std::ilogb(reach) - 1,
                                         1000)); // the scale may fall to 2^-1024, which is still a double
}

void BoxLevels::number_nodes(std::size_t items) {
    level_begin.clear();
    for (std::size_t many = items; level_begin.empty() || many > 1;)
        level_begin.push_back(many = (many + 3) / 4);
    resize_large(nodes, exclusive_scan(level_begin));
}

} // namespace facetmill
