#pragma once
// Distances from a surface to points that are near each other. One walk of the tree gathers the triangles
// that can be closest to any point. All pairs are then computed in float32, four points at a time, in the
// group's own frame.

#include "base/math/simd.hpp"
#include "geometry/spatial/face_tree.hpp"
#include "geometry/spatial/triangle_slabs.hpp"

#include <array>
#include <bit>
#include <span>
#include <vector>

namespace facetmill {

class GroupDistances {
  public:
    static constexpr std::size_t most = 32; ///< points in a group

    /// The tree must outlive this object. Each thread needs its own object.
    explicit GroupDistances(const FaceTree& tree) : tree_(tree) {}

    /// Measures 1 to `most` finite points; the nearer they are to each other, the faster. hint: a nearby
    /// triangle of the tree, or none; it affects only the time and is updated for the next group nearby.
    /// Returns false if measuring as a group gains nothing, because the surface has too many triangles
    /// nearby or is too far away. Query each point separately then.
    bool measure(std::span<const Vec3> points, Index& hint);

    /// Tries to prove that 1 to `most` finite points are all within a distance, which needs fewer triangles.
    /// hint: see `measure`. On success, distance(i) + error() is an upper bound of each point's distance.
    bool all_within(std::span<const Vec3> points, double distance, Index& hint);

    /// Stores 1 to `most` finite points for `within`, until the next call of another function. Returns false
    /// if the distance is too small, or the points are too far away, for a reliable result.
    bool lay_out(std::span<const Vec3> points, double distance);
    /// The stored points that are certainly within the distance of a triangle of the tree: bit i for the
    /// i-th. Complete for points in `among`, up to float32 error.
    std::uint32_t within(std::span<const Vec3> points, Index triangle, std::uint32_t among) const {
        return which_within(points, done_square_, triangle, among);
    }

    /// Removes from `among` the stored points that project into the inside of a triangle within the
    /// distance: call(i, triangle) for each. A point near an edge or a corner may stay although it is within
    /// the distance. Returns false, without a test, if so many triangles are near that fewer points are as
    /// fast.
    template <class Call>
    bool take_across(std::span<const Vec3> points, double distance, std::uint32_t& among, const Call& call) {
        if (!gather_near(points, distance, among)) return false;
        for (const std::uint32_t node : nodes_) {
            std::uint32_t near = near_node(node, distance) & among;
            if (near == 0) continue;
            const TriangleSlabs slabs = slabs_of(node);
            for (; near != 0; near &= near - 1) {
                const auto i = static_cast<std::size_t>(std::countr_zero(near));
                const unsigned holding = slabs.holding(x_[i / 4][i % 4], y_[i / 4][i % 4], z_[i / 4][i % 4]);
                if (holding == 0) continue;
                among &= ~(std::uint32_t{1} << i);
                call(i, 4 * node + static_cast<Index>(std::countr_zero(holding)));
            }
            if (among == 0) break;
        }
        return true;
    }

    /// Each set has bit i for the i-th of 1 to `most` finite points. Removes the sets whose points are all
    /// within a distance of a single triangle, because then everything between them is as well. Undecided
    /// sets stay. hint: see `measure`.
    void remove_within(std::span<const Vec3> points, double distance, std::vector<std::uint32_t>& sets,
                       Index& hint);

    // The following functions describe the i-th point of the last group that could be measured.

    /// The error is at most error(). The result is the same on every processor.
    double distance(std::size_t i) const { return distances_[i]; }
    double error() const { return error_; }
    /// The closest triangle, or a triangle that is as close up to the error, in the tree's order.
    Index triangle(std::size_t i) const { return triangles_[i]; }
    /// Whether every other triangle is certainly farther.
    bool is_certain(std::size_t i) const { return seconds_[i] - distances_[i] > 2 * error_; }

  private:
    struct Flat;

    bool gather_near(std::span<const Vec3> points, double distance, std::uint32_t among);
    std::uint32_t near_node(std::uint32_t node, double distance) const;
    TriangleSlabs slabs_of(std::uint32_t node) const;
    bool place(std::span<const Vec3> points, const Vec3& centre, double reach);
    bool gather(const Box& box, double limit, std::size_t most_nodes);
    Index next_near(const Vec3& point, double distance);
    bool compare_until(float enough_square, std::span<const Vec3> points, const Box& box, double limit);
    bool compare_nearer(std::span<const Vec3> points, const Box& box, std::uint32_t but);
    double limit() const;
    void take_distances(std::size_t count);
    Float4 squares_below(const Float4& limit, const Flat& flat, std::size_t four) const;
    void compare(const Flat& flat, Index triangle);
    float square_exactly(const Vec3& p, Index triangle) const;
    float enough_square(double distance) const;
    std::uint32_t which_within(std::span<const Vec3> points, float square, Index triangle,
                               std::uint32_t among) const;
    void compare_exactly(std::span<const Vec3> points, Index triangle);
    void compare(std::span<const Vec3> points, Index triangle);
    float farthest_square() const;

    const FaceTree& tree_;
    std::array<double, most> distances_{},
        seconds_{}; ///< distances to the closest and the second closest triangle
    std::array<Index, most> triangles_{};
    double error_ = 0;       ///< largest error, in the surface's units
    float done_square_ = -1; ///< points this near need no comparison with more triangles

    std::vector<std::uint32_t> nodes_,
        children_; ///< nodes of a level, and of the level below, that may contain the closest triangle
    std::vector<float> squares_; ///< squared distances from the box of the points to the boxes of the
                                 ///< children, in the tree's frame
    std::vector<Float4> tried_;  ///< per child of the gathered nodes: infinity if tried, otherwise 0

    // The following members are in the group's frame.
    Vec3 centre_;
    double scale_ = 1;
    std::size_t fours_ = 0;
    std::array<Float4, most / 4> x_, y_, z_; ///< coordinates of the points
    std::array<Float4, most / 4> least_,
        second_;                         ///< squared distances to the closest and second closest triangle
    std::array<Int4, most / 4> nearest_; ///< closest triangles
};

} // namespace facetmill
