#include "geometry/align/align.hpp"

#include "base/progress.hpp"
#include "geometry/deviation/deviation.hpp"
#include "geometry/measure/measure.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "mesh/transform.hpp"
#include "parallel/parallel.hpp"

#include <Eigen/Dense>
#include <numeric>

namespace facetmill {

namespace {

/// Points, their mean, and their principal axes as columns of a right-handed frame.
struct PointCloud {
    std::vector<Vec3> points;
    Vec3 centre;
    std::array<Vec3, 3> axes;
};

PointCloud cloud_of(const Surface& surface, const AlignSettings& s) {
    PointCloud cloud;
    for (const SurfaceSample& sample : sample_area(surface, s.samples, s.seed))
        cloud.points.push_back(sample.point);
    if (cloud.points.empty()) {
        const std::size_t step =
            std::max<std::size_t>(1, surface.corners.size() / std::max<std::size_t>(s.samples, 1));
        for (std::size_t c = 0; c < surface.corners.size(); c += step)
            if (const Vec3& p = surface.positions[surface.corners[c]]; is_finite(p))
                cloud.points.push_back(p);
    }
    const auto n = static_cast<double>(std::max<std::size_t>(cloud.points.size(), 1));
    for (const Vec3& p : cloud.points) cloud.centre += p / n;
    Symmetric spread;
    for (const Vec3& p : cloud.points) spread.add_square(p - cloud.centre);
    cloud.axes = eigen(spread).vectors;
    return cloud;
}

/// The transform that turns about `from` and moves it to `to`.
Transform turn(const std::array<Vec3, 3>& rows, const Vec3& from, const Vec3& to) {
    Transform t;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) t.m[i][k] = rows[i][k];
        t.m[i][3] = to[i] - dot(rows[i], from);
    }
    return t;
}

/// The 24 rotations that map the axes of `a` to those of `b` up to order and signs.
std::vector<Transform> starts_by_axes(const PointCloud& a, const PointCloud& b) {
    std::vector<Transform> all;
    std::array<std::size_t, 3> order{0, 1, 2};
    do
        for (int signs = 0; signs < 4; ++signs) {
            Vec3 x = a.axes[order[0]] * (signs & 1 ? -1 : 1), y = a.axes[order[1]] * (signs & 2 ? -1 : 1),
                 z = cross(x, y);
            std::array<Vec3, 3> rows;
            for (std::size_t i = 0; i < 3; ++i)
                rows[i] = x * b.axes[0][i] + y * b.axes[1][i] + z * b.axes[2][i];
            all.push_back(turn(rows, a.centre, b.centre));
        }
    while (std::next_permutation(order.begin(), order.end()));
    return all;
}

class Icp {
  public:
    Icp(const FaceTree& target, double diagonal, double keep)
        : target_(target), diagonal_(diagonal), keep_(keep) {}

    struct State {
        Transform move;
        double rms = HUGE_VAL, whole = HUGE_VAL, farthest = 0; ///< whole: rms of all samples
        int steps = 0;
        bool settled = false;
    };

    State run(const std::vector<Vec3>& points, const Transform& start, int most_steps) const {
        State state{start};
        for (; state.steps < most_steps && !state.settled; ++state.steps) {
            const Pairs pairs = pairs_of(points, state.move);
            const Transform next = step(pairs) * state.move;
            double moved = 0;
            for (const Vec3& p : pairs.kept_sources)
                moved = std::max(moved, length(next.point(p) - state.move.point(p)));
            state.move = next;
            state.settled = moved < 1e-8 * diagonal_;
        }
        const Pairs last = pairs_of(points, state.move);
        state.rms = last.rms;
        state.whole = last.whole;
        state.farthest = last.farthest;
        return state;
    }

  private:
    /// The used samples after the move, with their nearest points and the normals at these points.
    struct Pairs {
        std::vector<Vec3> kept_sources, moved, nearest, normals;
        double rms = 0, whole = 0, farthest = 0;
    };

    Pairs pairs_of(const std::vector<Vec3>& points, const Transform& move) const {
        std::vector<Vec3> moved(points.size());
        parallel_for(points.size(), [&](std::size_t i) { moved[i] = move.point(points[i]); });
        const std::vector<Closest> found = closest_points(target_, moved, OfSeveral::any);
        std::vector<Index> order(points.size());
        std::iota(order.begin(), order.end(), Index{0});
        const auto count = std::max<std::size_t>(
            1, static_cast<std::size_t>(std::llround(keep_ * static_cast<double>(points.size()))));
        std::sort(order.begin(), order.end(), [&](Index a, Index b) {
            return found[a].distance != found[b].distance ? found[a].distance < found[b].distance : a < b;
        });
        order.resize(std::min(order.size(), count));
        std::sort(order.begin(), order.end()); // sums follow the samples, not their distances
        Pairs pairs;
        double squares = 0;
        for (const Closest& c : found)
            if (c.triangle != none) pairs.whole += c.distance * c.distance;
        pairs.whole = std::sqrt(pairs.whole / static_cast<double>(std::max<std::size_t>(found.size(), 1)));
        for (const Index i : order) {
            if (found[i].triangle == none) continue;
            const FaceTree::Triangle t = target_.triangle(found[i].triangle);
            pairs.kept_sources.push_back(points[i]);
            pairs.moved.push_back(moved[i]);
            pairs.nearest.push_back(found[i].point);
            pairs.normals.push_back(normalised(cross(t.b - t.a, t.c - t.a)));
            squares += found[i].distance * found[i].distance;
            pairs.farthest = std::max(pairs.farthest, found[i].distance);
        }
        if (!pairs.moved.empty()) pairs.rms = std::sqrt(squares / static_cast<double>(pairs.moved.size()));
        return pairs;
    }

    /// The small move that brings the samples nearest to the planes. Moves along which distances do not
    /// change, such as a turn of a cylinder about its axis, stay small by a term of a millionth.
    Transform step(const Pairs& pairs) const {
        using Matrix = Eigen::Matrix<double, 6, 6>;
        using Vector = Eigen::Matrix<double, 6, 1>;
        Matrix normal = Matrix::Zero();
        Vector right = Vector::Zero();
        Vec3 centre;
        for (const Vec3& p : pairs.moved) centre += p / static_cast<double>(pairs.moved.size());
        const auto add = [&](const Vec3& p, const Vec3& direction, double offset, double weight) {
            const Vec3 arm = cross((p - centre) / diagonal_, direction);
            Vector row;
            row << arm.x, arm.y, arm.z, direction.x, direction.y, direction.z;
            normal += weight * row * row.transpose();
            right += weight * offset * row;
        };
        for (std::size_t i = 0; i < pairs.moved.size(); ++i) {
            const Vec3 gap = pairs.nearest[i] - pairs.moved[i];
            if (dot(pairs.normals[i], pairs.normals[i]) > 0) {
                add(pairs.moved[i], pairs.normals[i], dot(gap, pairs.normals[i]), 1);
                continue;
            }
            for (std::size_t axis = 0; axis < 3; ++axis) { // a target without area: towards the point
                Vec3 direction;
                direction[axis] = 1;
                add(pairs.moved[i], direction, gap[axis], 1);
            }
        }
        normal += Matrix::Identity() * (1e-6 * normal.trace() / 6 + 1e-300);
        const Vector x = normal.ldlt().solve(right);
        const Vec3 turned = Vec3{x[0], x[1], x[2]} / diagonal_, by{x[3], x[4], x[5]};
        if (!is_finite(turned) || !is_finite(by)) return {};
        const double angle = length(turned);
        const Vec3 axis = angle > 0 ? turned / angle : Vec3{1, 0, 0};
        std::array<Vec3, 3> rows;
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3 unit;
            unit[k] = 1;
            const Vec3 column = rotated(unit, axis, angle);
            for (std::size_t i = 0; i < 3; ++i) rows[i][k] = column[i];
        }
        return turn(rows, centre, centre + by);
    }

    const FaceTree& target_;
    double diagonal_, keep_;
};

/// Removes the rounding errors of many products from a rotation.
Transform orthonormal(Transform t, const Vec3& fixed) {
    const Vec3 to = t.point(fixed);
    const Vec3 x = normalised(Vec3{t.m[0][0], t.m[0][1], t.m[0][2]});
    Vec3 y{t.m[1][0], t.m[1][1], t.m[1][2]};
    y = normalised(y - x * dot(x, y));
    return turn({x, y, cross(x, y)}, fixed, to);
}

} // namespace

AlignResult align(const Surface& moving, const Surface& target, const AlignSettings& s) {
    AlignResult result;
    const PointCloud own = cloud_of(moving, s), other = cloud_of(target, s);
    const double diagonal = target.bounds().diagonal();
    const FaceTree tree(target, FaceTree::Use::few);
    if (own.points.empty() || tree.empty() || !(diagonal > 0)) return result;
    const Icp icp(tree, diagonal, s.keep);
    std::vector<Vec3> few;
    constexpr std::size_t few_samples = 500;
    for (std::size_t i = 0; i < own.points.size();
         i += std::max<std::size_t>(1, own.points.size() / few_samples))
        few.push_back(own.points[i]);
    std::vector<Transform> starts{{}};
    if (s.from_axes)
        for (const Transform& t : starts_by_axes(own, other)) starts.push_back(t);
    result.starts = starts.size();
    Icp::State best;
    for (std::size_t i = 0; i < starts.size(); ++i) {
        ProgressScope::report_item(i, 2 * starts.size());
        const Icp::State state = icp.run(few, starts[i], 20);
        // Poses of a nearly symmetric shape may differ only in the samples that do not count.
        const double slack = 1e-3 * diagonal;
        if (state.rms < best.rms - slack || (state.rms < best.rms + slack && state.whole < best.whole))
            best = state;
    }
    result.before = icp.run(own.points, {}, 0).rms;
    const Icp::State done = icp.run(own.points, best.move, s.iterations);
    result.move = orthonormal(done.move, own.centre);
    result.after = done.rms;
    result.farthest = done.farthest;
    result.iterations = done.steps;
    result.settled = done.settled;
    return result;
}

} // namespace facetmill
