#pragma once
// A tree over the triangles of a surface, for closest points and rays.
// Axis-aligned boxes separate poorly for a query far from a smooth surface: hundreds of boxes begin before
// the nearest triangle does (measured: 215 triangles tried for a random point of the bounding box of a scan
// of 1.1M). So the lower levels also have boxes turned to fit their piece of the surface.

#include "base/math/simd.hpp"
#include "geometry/spatial/box_levels.hpp"
#include "mesh/surface.hpp"

#include <span>

namespace facetmill {

/// Built once, in parallel, the same for any number of threads; then only read.
struct FaceTree : BoxLevels {
    enum class Use {
        all,
        rays,  ///< rays alone: faster to build, without support for distances
        near,  ///< closest points alone, most of them near the surface: faster to build; see flatten
        few,   ///< likewise, for fewer points than the surface has triangles: built twice as fast, each query
               ///< slower
        coarse ///< likewise, for far fewer points: a box holds eight triangles, so the tree has few boxes
    };
    /// Four boxes turned to the mean normal of their contents, in the tree's frame: the points centre + sum
    /// of axis[i] * x[i] with |x[i]| <= half[i]. Empty slots have half = -infinity.
    struct Patches {
        float centre[3][4], axis[3][3][4], half[3][4];
    };
    /// Four triangles, each as the points with normal.x = offset and beyond[i].x <= reach[i]: its plane, and
    /// the half spaces behind its edges. All vectors have unit length. Empty slots have reach = -infinity.
    struct Plates {
        float normal[3][4], offset[4], beyond[3][3][4], reach[3][4];
    };
    struct Triangle {
        Vec3 a, b, c;
    };

    explicit FaceTree(const Surface& surface, Use use = Use::all);
    /// For near or few points. The surface must have these bounds and must not change while the tree is used
    /// (moving the object is allowed). The tree stores no triangles, which saves a third of its size.
    static FaceTree over(const Surface& surface, const Box& bounds, Use use);

    /// Makes plates and patches, which a tree for near points lacks. They find points farther from the
    /// surface than its triangles are long three times as fast.
    void flatten();

    bool empty() const { return nodes.empty(); }
    std::size_t size() const { return triangles.empty() ? sources.size() : triangles.size(); }
    Triangle triangle(std::size_t t) const {
        if (!triangles.empty()) return triangles[t];
        const Index* const c = &corners_[3 * std::size_t{sources[t]}];
        return {positions_[c[0]], positions_[c[1]], positions_[c[2]]};
    }
    /// The face of triangle t.
    Index face(std::size_t t) const {
        if (!faces.empty()) return faces[t];
        return faces_.empty() ? sources[t] : faces_[sources[t]];
    }
    /// Prefetches a triangle that is read soon.
    [[gnu::always_inline]] void fetch_triangle(std::size_t t) const {
        if (!triangles.empty()) {
            fetch_soon(triangles[t]);
            return;
        }
        const Index* const c = &corners_[3 * std::size_t{sources[t]}];
        for (std::size_t k = 0; k < 3; ++k) fetch_soon(positions_[c[k]]);
    }
    /// The turned boxes of the children of a node, on levels 1 to patch_levels.
    const Patches& patch(int level, std::size_t i) const {
        return patches[patch_begin[static_cast<std::size_t>(level) - 1] + i];
    }

    /// Triangles with finite corners, in the order of geometry/spatial/median_order.hpp; empty in a tree
    /// over a surface that stays.
    std::vector<Triangle> triangles;
    std::vector<Index> faces;   ///< of triangles, likewise
    std::vector<Index> sources; ///< of triangles, in a tree for near points: the index of each in the surface
    std::vector<Plates> plates; ///< of triangles 4i to 4i + 3
    int patch_levels = -1;      ///< at most 2; higher pieces are too curved to benefit. -1: no plates either
    std::vector<std::size_t> patch_begin; ///< into patches
    std::vector<Patches> patches;
    int run_bits = 0; ///< 2^run_bits triangles in a row share a box of the lowest level
    double reach = 1; ///< of everything, in the tree's frame: above 1 some of it lies outside

  private:
    FaceTree() = default;
    void build_over(const Surface& surface, const Box& all, Use use, bool keeps_triangles);
    void set_dense_frame(const Surface& surface, const Box& all, const std::vector<Index>& kept);
    /// The number of the lowest boxes.
    std::size_t run_count() const { return (size() + (std::size_t{1} << run_bits) - 1) >> run_bits; }
    /// The kept triangles, in the order of the tree.
    std::vector<Index> in_median_order(const Surface& surface, const std::vector<Index>& kept) const;
    std::vector<Index> along_curve(const Surface& surface, const std::vector<Index>& kept) const;
    std::vector<Index> runs_along_curve(const Surface& surface, const std::vector<Index>& kept,
                                        std::size_t length) const;
    std::vector<Index> in_order(const Surface& surface, const std::vector<Index>& kept, Use use) const;

    std::span<const Vec3> positions_; ///< members of the surface that stays
    std::span<const Index> corners_, faces_;
};

} // namespace facetmill
