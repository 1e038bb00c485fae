#include "geometry/face_tree.hpp"

#include "base/parallel.hpp"
#include "geometry/space_curve.hpp"

#include <algorithm>

namespace facetmill {

namespace {

using Node = FaceTree::Node;

constexpr std::size_t node_chunk = 2048;

bool is_finite(const Surface& surface, std::size_t t) {
    return facetmill::is_finite(surface.point(t, 0)) && facetmill::is_finite(surface.point(t, 1)) &&
           facetmill::is_finite(surface.point(t, 2));
}

/// The numbers of the triangles with finite corners, ascending.
std::vector<Index> finite_triangles(const Surface& surface) {
    std::vector<Index> kept;
    kept.reserve(surface.size());
    for (std::size_t t = 0; t < surface.size(); ++t)
        if (is_finite(surface, t)) kept.push_back(static_cast<Index>(t));
    return kept;
}

void clear(Node& node, std::size_t slot) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        node.min[axis][slot] = HUGE_VALF, node.max[axis][slot] = -HUGE_VALF;
}

void set_to_triangle(Node& node, std::size_t slot, const FaceTree& tree, const FaceTree::Triangle& t) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax({t.a[axis], t.b[axis], t.c[axis]});
        node.min[axis][slot] = rounded_down(tree.local(low, axis));
        node.max[axis][slot] = rounded_up(tree.local(high, axis));
    }
}

void set_to_node(Node& node, std::size_t slot, const Node& child) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        node.min[axis][slot] = *std::min_element(child.min[axis], child.min[axis] + 4);
        node.max[axis][slot] = *std::max_element(child.max[axis], child.max[axis] + 4);
    }
}

/// Fills the nodes of one level; set(node, slot, i) for child i of the level.
template <class Set>
void fill(std::vector<Node>& nodes, std::size_t begin, std::size_t count, std::size_t children, Set&& set) {
    parallel_for(
        count,
        [&](std::size_t n) {
            for (std::size_t slot = 0; slot < 4; ++slot)
                if (4 * n + slot < children)
                    set(nodes[begin + n], slot, 4 * n + slot);
                else
                    clear(nodes[begin + n], slot);
        },
        node_chunk);
}

} // namespace

FaceTree::FaceTree(const Surface& surface) {
    const std::vector<Index> kept = finite_triangles(surface);
    if (kept.empty()) return;
    const Box all = surface.bounds();
    middle = all.min * 0.5 + all.max * 0.5; // halved first: the sum of huge coordinates would overflow
    const Vec3 half = all.max - middle;
    const double reach = std::max({half.x, half.y, half.z});
    if (reach > 0 && std::isfinite(reach))
        scale = std::ldexp(1.0, std::clamp(-std::ilogb(reach) - 1, -1000, 1000));
    const auto centre = [&](std::size_t i) {
        const std::size_t t = kept[i];
        return (surface.point(t, 0) + surface.point(t, 1) + surface.point(t, 2)) / 3;
    };
    const std::vector<Index> order = order_along_curve(kept.size(), all, centre);
    triangles.resize(kept.size());
    faces.resize(kept.size());
    parallel_for(kept.size(), [&](std::size_t i) {
        const std::size_t t = kept[order[i]];
        triangles[i] = {surface.point(t, 0), surface.point(t, 1), surface.point(t, 2)};
        faces[i] = surface.face(t);
    });

    std::vector<std::size_t> counts;
    for (std::size_t count = triangles.size(); counts.empty() || count > 1;)
        counts.push_back(count = (count + 3) / 4);
    level_begin = counts;
    nodes.resize(exclusive_scan(level_begin));
    fill(nodes, 0, counts[0], triangles.size(), [&](Node& node, std::size_t slot, std::size_t child) {
        set_to_triangle(node, slot, *this, triangles[child]);
    });
    for (std::size_t level = 1; level < counts.size(); ++level)
        fill(nodes, level_begin[level], counts[level], counts[level - 1],
             [&](Node& node, std::size_t slot, std::size_t child) {
                 set_to_node(node, slot, nodes[level_begin[level - 1] + child]);
             });

    flatten();
}

} // namespace facetmill
