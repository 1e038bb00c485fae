#include "geometry/spatial/box_tree.hpp"

#include "parallel/parallel.hpp"

namespace facetmill {

namespace {

/// The low 21 bits of x, with two zeros after each.
std::uint64_t spread(std::uint64_t x) {
    x = (x | x << 32) & 0x1f00000000ffffULL;
    x = (x | x << 16) & 0x1f0000ff0000ffULL;
    x = (x | x << 8) & 0x100f00f00f00f00fULL;
    x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
    return (x | x << 2) & 0x1249249249249249ULL;
}

constexpr int axis_bits = 14; // 42 bits in all: four passes of the radix sort

/// The position of a cell on the curve of G. M. Morton, "A computer oriented geodetic data base and a new
/// technique in file sequencing" (1966).
std::uint64_t morton(const Vec3& p, const Box& all) {
    std::uint64_t code = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double extent = all.max[i] - all.min[i];
        const double t = extent > 0 ? (p[i] - all.min[i]) / extent : 0; // in [0, 1], or not a number
        const double cell = t * ((1 << axis_bits) - 1);
        code |= spread(cell >= 0 ? static_cast<std::uint64_t>(cell) : 0) << i;
    }
    return code;
}

struct Placed {
    std::uint64_t code;
    Index item;
};

/// The level of nodes above, over groups of `many` boxes each.
std::vector<Box> above(const std::vector<Box>& below, std::size_t many) {
    std::vector<Box> nodes((below.size() + many - 1) / many);
    parallel_for(nodes.size(), [&](std::size_t n) {
        for (std::size_t i = n * many; i < std::min(below.size(), (n + 1) * many); ++i)
            nodes[n].add(below[i]);
    });
    return nodes;
}

} // namespace

Box box_of_all(std::span<const Box> boxes) {
    return parallel_reduce(
        boxes.size(), Box{},
        [&](std::size_t begin, std::size_t end) {
            Box b;
            for (std::size_t i = begin; i < end; ++i) b.add(boxes[i]);
            return b;
        },
        [](Box a, const Box& b) {
            a.add(b);
            return a;
        });
}

BoxTree::BoxTree(std::vector<Box> boxes) {
    if (boxes.empty()) return;
    const Box all = box_of_all(boxes);
    std::vector<Placed> placed(boxes.size());
    parallel_for(placed.size(), [&](std::size_t i) {
        placed[i] = {boxes[i].empty() ? 0 : morton(boxes[i].centre(), all), static_cast<Index>(i)};
    });
    radix_sort(
        placed, [](const Placed& p) { return p.code; }, 3 * axis_bits);
    items_.resize(boxes.size());
    boxes_.resize(boxes.size());
    parallel_for(placed.size(), [&](std::size_t i) {
        items_[i] = placed[i].item;
        boxes_[i] = boxes[placed[i].item];
    });
    levels_.push_back(above(boxes_, leaf));
    while (levels_.back().size() > 1) levels_.push_back(above(levels_.back(), 2));
}

} // namespace facetmill
