#pragma once
// A tree over the triangles of a surface, for closest points and rays. For a query far from a smooth
// surface, axis-aligned boxes separate poorly: hundreds of boxes are nearer than the nearest triangle. (A
// random point in the box of a scan with 1.1M triangles tested 215 triangles.) So the lower levels also have
// boxes turned to fit the surface.

#include "base/math/simd.hpp"
#include "geometry/spatial/box_levels.hpp"
#include "mesh/surface.hpp"

#include <span>

namespace facetmill {

/// Built once, in parallel, and then only read. It does not depend on the number of threads.
struct FaceTree : BoxLevels {
    enum class Use {
        all,
        rays,  ///< rays only: faster to build, without support for distances
        near,  ///< closest points only, most of them near the surface: faster to build; see flatten
        few,   ///< closest points only, fewer than the surface has triangles: built twice as fast, slower
               ///< queries
        coarse ///< closest points only, far fewer than triangles: a box has eight triangles, so the tree has
               ///< few boxes
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
    /// A tree for near or few points. The surface must have these bounds, and must not change while the tree
    /// is used (moving the object is allowed). The tree stores no triangles, which saves a third of its
    /// size.
    static FaceTree over(const Surface& surface, const Box& bounds, Use use);

    /// Makes plates and patches, which a tree for near points lacks. With these, queries farther from the
    /// surface than the length of its triangles are three times as fast.
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
    /// Prefetches a triangle that will be read soon.
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
    /// that refers to the surface.
    std::vector<Triangle> triangles;
    std::vector<Index> faces;   ///< faces of triangles; empty in such a tree
    std::vector<Index> sources; ///< in a tree for near points: the index of each triangle in the surface
    std::vector<Plates> plates; ///< plates of triangles 4i to 4i + 3
    int patch_levels =
        -1; ///< at most 2, because higher pieces are too curved to benefit; -1: no plates either
    std::vector<std::size_t> patch_begin; ///< offsets into patches
    std::vector<Patches> patches;
    int run_bits = 0; ///< 2^run_bits triangles in a row share a box of the lowest level
    double reach = 1; ///< extent of all triangles in the tree's frame; above 1, some are outside the frame

  private:
    FaceTree() = default;
    void build_over(const Surface& surface, const Box& all, Use use, bool keeps_triangles);
    void set_dense_frame(const Surface& surface, const Box& all, const std::vector<Index>& kept);
    /// The number of boxes on the lowest level.
    std::size_t run_count() const { return (size() + (std::size_t{1} << run_bits) - 1) >> run_bits; }
    /// The kept triangles, in the order of the tree.
    std::vector<Index> in_median_order(const Surface& surface, const std::vector<Index>& kept) const;
    std::vector<Index> along_curve(const Surface& surface, const std::vector<Index>& kept) const;
    std::vector<Index> runs_along_curve(const Surface& surface, const std::vector<Index>& kept,
                                        std::size_t length) const;
    std::vector<Index> in_order(const Surface& surface, const std::vector<Index>& kept, Use use) const;

    std::span<const Vec3> positions_; ///< members of the surface that the tree refers to
    std::span<const Index> corners_, faces_;
};

} // namespace facetmill
