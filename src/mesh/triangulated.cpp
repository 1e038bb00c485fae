// Cuts polygons into triangles without new points.
#include "base/math/predicates.hpp"
#include "mesh/quad_diagonal.hpp"
#include "parallel/parallel.hpp"
#include "parallel/storage.hpp"

#include <algorithm>
#include <array>

namespace facetmill {

namespace {

struct Point2 {
    double x, y;
};

int turn(const Point2& a, const Point2& b, const Point2& c) {
    return orientation_2d(a.x, a.y, b.x, b.y, c.x, c.y);
}

using Triangle = std::array<Index, 3>; // positions in the polygon, 0 to n - 1

/// A polygon projected along the axis nearest to its normal, so that it runs anticlockwise. Dropping a
/// coordinate keeps the others, and so the turns, exact.
std::vector<Point2> flattened(const Mesh& mesh, Index f) {
    const Index begin = mesh.face_begin(f), n = mesh.face_size(f);
    Vec3 normal;
    for (Index i = 1; i + 1 < n; ++i)
        normal +=
            cross(mesh.point(begin + i) - mesh.point(begin), mesh.point(begin + i + 1) - mesh.point(begin));
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
    std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (normal[axis] < 0) std::swap(u, v);
    std::vector<Point2> points(n);
    for (Index i = 0; i < n; ++i) points[i] = {mesh.point(begin + i)[u], mesh.point(begin + i)[v]};
    return points;
}

bool fan_works(const std::vector<Point2>& p, std::size_t from) {
    const std::size_t n = p.size();
    for (std::size_t i = 1; i + 1 < n; ++i)
        if (turn(p[from], p[(from + i) % n], p[(from + i + 1) % n]) <= 0) return false;
    return true;
}

/// Clips ears from a ring of corners. Only reflex corners can be inside an ear.
class EarClipper {
  public:
    explicit EarClipper(const std::vector<Point2>& points)
        : p_(points), next_(points.size()), previous_(points.size()) {
        const auto n = static_cast<Index>(points.size());
        for (Index i = 0; i < n; ++i) {
            next_[i] = (i + 1) % n;
            previous_[i] = (i + n - 1) % n;
        }
        for (Index i = 0; i < n; ++i)
            if (turn_at(i) <= 0) reflex_.push_back(i);
    }

    template <class Out>
    void run(Out&& out) {
        std::size_t left = p_.size(), since_ear = 0;
        Index i = 0;
        while (left > 3) {
            // A polygon that crosses itself may have no ear left. Cutting any corner keeps the number of
            // triangles right.
            if (is_ear(i) || since_ear > left) {
                out(Triangle{previous_[i], i, next_[i]});
                i = cut(i);
                --left;
                since_ear = 0;
            } else {
                i = next_[i];
                ++since_ear;
            }
        }
        out(Triangle{previous_[i], i, next_[i]});
    }

  private:
    int turn_at(Index i) const { return turn(p_[previous_[i]], p_[i], p_[next_[i]]); }

    bool is_ear(Index i) const {
        const Index a = previous_[i], b = next_[i];
        if (turn_at(i) <= 0) return false;
        return std::none_of(reflex_.begin(), reflex_.end(), [&](Index r) {
            if (r == a || r == i || r == b) return false;
            const Point2& q = p_[r];
            if ((q.x == p_[a].x && q.y == p_[a].y) || (q.x == p_[b].x && q.y == p_[b].y))
                return false; // a bridge to a hole
            return turn(p_[a], p_[i], q) >= 0 && turn(p_[i], p_[b], q) >= 0 && turn(p_[b], p_[a], q) >= 0;
        });
    }

    /// Removes corner i. Returns the corner to continue with, two further, which spreads the cuts around the
    /// ring.
    Index cut(Index i) {
        const Index a = previous_[i], b = next_[i];
        next_[a] = b;
        previous_[b] = a;
        std::erase_if(reflex_, [&](Index r) { return r == i || ((r == a || r == b) && turn_at(r) > 0); });
        return next_[b];
    }

    const std::vector<Point2>& p_;
    std::vector<Index> next_, previous_, reflex_;
};

/// Calls out(Triangle) for the triangles of face f, always two fewer than its corners. at_second: cuts a
/// quad from its second corner.
template <class Out>
void cut_face(const Mesh& mesh, Index f, bool at_second, Out&& out) {
    const Index n = mesh.face_size(f);
    const auto fan = [&](Index from) {
        for (Index i = 1; i + 1 < n; ++i) out(Triangle{from, (from + i) % n, (from + i + 1) % n});
    };
    if (n == 3) return fan(0);
    if (n == 4) return fan(at_second ? 1 : 0);
    const auto points = flattened(mesh, f);
    constexpr Index tried = 16; // each trial is linear; ear clipping handles the rest
    for (Index from = 0; from < std::min(n, tried); ++from)
        if (fan_works(points, from)) return fan(from);
    EarClipper(points).run(out);
}

} // namespace

Mesh triangulated(const Mesh& mesh) {
    if (mesh.all_triangles()) return mesh;
    const std::size_t faces = mesh.face_count();
    std::vector<Index> first(faces);
    parallel_for(faces, [&](std::size_t f) {
        const Index n = mesh.face_size(static_cast<Index>(f));
        first[f] = n < 3 ? 0 : n - 2;
    });
    const Index triangles = exclusive_scan(first);
    const QuadCuts cuts = quad_cuts(mesh);
    Mesh result;
    result.positions = mesh.positions;
    result.wedge_vertex = mesh.wedge_vertex;
    result.attributes = mesh.attributes;
    result.primitives = mesh.primitives;
    resize_large(result.corners, std::size_t{triangles} * 3);
    std::vector<Index> parent(triangles);
    parallel_for(
        faces,
        [&](std::size_t i) {
            const auto f = static_cast<Index>(i);
            if (mesh.face_size(f) < 3) return;
            Index at = first[f];
            cut_face(mesh, f, cuts.at_second[f], [&](const Triangle& t) {
                parent[at] = f;
                for (std::size_t k = 0; k < 3; ++k)
                    result.corners[std::size_t{at} * 3 + k] = mesh.corners[mesh.face_begin(f) + t[k]];
                ++at;
            });
        },
        1024);
    for (auto& a : result.attributes)
        if (a.domain == Domain::face) a.select(parent);
    return result;
}

} // namespace facetmill
