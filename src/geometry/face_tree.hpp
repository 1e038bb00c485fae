#pragma once
// A tree over the triangles of a surface, for closest points and rays: boxes of float32, four to a node, so
// that the processor tests four at a time.
//
// The triangles lie along a Hilbert curve and every node stands over four neighbours of the level below, so
// the tree needs no pointers and building it is a sort. A tree split by surface area was not tried: it would
// take longer to build than 100,000 queries take to answer.

#include "geometry/surface.hpp"

namespace facetmill {

/// Built once, in parallel, the same for any number of threads; then only read.
struct FaceTree {
    /// Four boxes in the tree's own frame (see local), a little larger than what they hold. Empty slots have
    /// min = infinity, max = -infinity.
    struct Node {
        float min[3][4], max[3][4];
    };
    struct Triangle {
        Vec3 a, b, c;
    };

    explicit FaceTree(const Surface& surface);

    bool empty() const { return triangles.empty(); }
    int height() const { return static_cast<int>(level_begin.size()); }
    /// Node i of a level; its child s is triangle 4i + s on level 0, node 4i + s of the level below above.
    const Node& node(int level, std::size_t i) const {
        return nodes[level_begin[static_cast<std::size_t>(level)] + i];
    }
    /// The tree's frame has the middle of the surface as origin and all of it within [-1, 1]. Rounding is
    /// monotone, so what is between two numbers stays between them.
    double local(double x, std::size_t axis) const { return (x - middle[axis]) * scale; }

    Vec3 middle;
    double scale = 1;                     ///< a power of two
    std::vector<Triangle> triangles;      ///< those with finite corners, along the curve
    std::vector<Index> faces;             ///< of triangles
    std::vector<std::size_t> level_begin; ///< into nodes; the last level is the root alone
    std::vector<Node> nodes;
};

/// Numbers of the tree's frame as float32, rounded down and up by more than the rounding of either.
inline float rounded_down(double x) { return static_cast<float>(x - std::abs(x) * 0x1p-22); }
inline float rounded_up(double x) { return static_cast<float>(x + std::abs(x) * 0x1p-22); }

} // namespace facetmill
