#pragma once
// A tree over the triangles of a surface, for closest points and rays.
//
// Boxes along the axes say little to a point far from a smooth surface: seen from there, hundreds of them
// begin before the nearest triangle does (measured: 215 triangles tried for a random point of the bounding
// box of a scan of 1.1M). So the lower levels also have boxes turned to lie flat along their piece of the
// surface.

#include "base/math/simd.hpp"
#include "geometry/spatial/box_levels.hpp"
#include "mesh/surface.hpp"

#include <span>

namespace facetmill {

/// Built once, in parallel, the same for any number of threads; then only read.
struct FaceTree : BoxLevels {
    enum class Use {
        all,
        rays,  ///< rays alone: made faster, and knows no distances
        near,  ///< closest points alone, most of them near the surface: made faster; see flatten
        few,   ///< likewise, of fewer points than the surface has triangles: made twice as fast, each point
               ///< slower
        coarse ///< likewise, of far fewer points: a box holds eight triangles, so that there are few boxes
    };
    /// Four boxes turned to the mean normal of what they hold, in the tree's frame: the points centre + sum
    /// of axis[i] * x[i] with |x[i]| <= half[i]. Empty slots have half = -infinity.
    struct Patches {
        float centre[3][4], axis[3][3][4], half[3][4];
    };
    /// Four triangles, each as the points with normal.x = offset and beyond[i].x <= reach[i]: its plane, and
    /// the half spaces across it behind its edges. All vectors have unit length. Empty slots have reach =
    /// -infinity.
    struct Plates {
        float normal[3][4], offset[4], beyond[3][3][4], reach[3][4];
    };
    struct Triangle {
        Vec3 a, b, c;
    };

    explicit FaceTree(const Surface& surface, Use use = Use::all);
    /// For near or few points, of a surface that has these bounds and stays as it is for as long as the tree
    /// is used (it may be moved): the tree keeps no triangles of its own, a third of its size.
    static FaceTree over(const Surface& surface, const Box& bounds, Use use);

    /// Makes plates and patches, which a tree for near points does without: points that are farther from the
    /// surface than its triangles are long are found three times as fast with them.
    void flatten();

    bool empty() const { return nodes.empty(); }
    std::size_t size() const { return triangles.empty() ? sources.size() : triangles.size(); }
    Triangle triangle(std::size_t t) const {
        if (!triangles.empty()) return triangles[t];
        const Index* const c = &corners_[3 * std::size_t{sources[t]}];
        return {positions_[c[0]], positions_[c[1]], positions_[c[2]]};
    }
    /// The face that triangle t is of.
    Index face(std::size_t t) const {
        if (!faces.empty()) return faces[t];
        return faces_.empty() ? sources[t] : faces_[sources[t]];
    }
    /// Asks the memory for a triangle that is read soon.
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

    /// Those with finite corners, neighbours by geometry/spatial/median_order.hpp; none in a tree over a
    /// surface that stays.
    std::vector<Triangle> triangles;
    std::vector<Index> faces;   ///< of triangles, likewise
    std::vector<Index> sources; ///< of triangles, in a tree for near points: which of the surface's each is
    std::vector<Plates> plates; ///< of triangles 4i to 4i + 3
    int patch_levels = -1;      ///< at most 2; above, pieces are too curved to gain. -1: no plates either
    std::vector<std::size_t> patch_begin; ///< into patches
    std::vector<Patches> patches;
    int run_bits = 0; ///< 2^run_bits triangles in a row share a box of the lowest level
    double reach = 1; ///< of everything, in the tree's frame: above 1 some of it lies outside

  private:
    FaceTree() = default;
    void build_over(const Surface& surface, const Box& all, Use use, bool keeps_triangles);
    void set_dense_frame(const Surface& surface, const Box& all, const std::vector<Index>& kept);
    /// How many of the lowest boxes there are.
    std::size_t run_count() const { return (size() + (std::size_t{1} << run_bits) - 1) >> run_bits; }
    /// The triangles that were kept, in the order of the tree.
    std::vector<Index> in_median_order(const Surface& surface, const std::vector<Index>& kept) const;
    std::vector<Index> along_curve(const Surface& surface, const std::vector<Index>& kept) const;
    std::vector<Index> runs_along_curve(const Surface& surface, const std::vector<Index>& kept,
                                        std::size_t length) const;
    std::vector<Index> in_order(const Surface& surface, const std::vector<Index>& kept, Use use) const;

    std::span<const Vec3> positions_; ///< of the surface that stays, and so on
    std::span<const Index> corners_, faces_;
};

} // namespace facetmill
