// The clean step that moves vertices apart that have the same position but belong to different fans.
#include "base/math/numbers.hpp"
#include "base/math/predicates.hpp"
#include "base/text/words.hpp"
#include "geometry/clean/steps.hpp"
#include "geometry/cut/cut.hpp"
#include "geometry/spatial/box_tree.hpp"
#include "mesh/face.hpp"
#include "mesh/float32_ulp.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace facetmill::clean_steps {

namespace {

/// At least two steps, so that vertices stay distinct after scaling to another unit and rounding again.
/// Relative to the value, the step varies by a factor of two between powers of two.
constexpr int fewest_float_steps = 2, most_float_steps = 256;

/// The distance between adjacent float32 numbers at the farthest coordinate.
double float_step_of(const Mesh& mesh) {
    Box box;
    for (const Vec3& p : mesh.positions)
        if (is_finite(p)) box.add(p);
    return float32_ulp(box);
}

Box grown(Box box, double by) {
    if (box.empty()) return box;
    return {box.min - Vec3{by, by, by}, box.max + Vec3{by, by, by}};
}

using FacePairs = std::vector<std::pair<Index, Index>>;

struct Meetings {
    FacePairs crossing, all; ///< ascending pairs; `all` includes pairs that only touch
};

/// The faces near a vertex as a separate mesh.
struct Neighbourhood {
    Mesh mesh;
    Index vertex = none;              ///< the vertex's number in the mesh
    std::vector<std::uint8_t> around; ///< [faces] 1 for faces at the vertex

    Meetings meetings() const {
        const SelfIntersections found =
            find_self_intersections(mesh, {.limit = max_pairs, .among = around, .separate_touching = true});
        Meetings m{found.pairs, found.pairs};
        m.all.insert(m.all.end(), found.touching_pairs.begin(), found.touching_pairs.end());
        std::sort(m.all.begin(), m.all.end());
        return m;
    }
};

/// The turning directions of corners at a vertex's faces, projected along the dominant axis of each face.
class Turns {
  public:
    explicit Turns(const Neighbourhood& n) : n_(n) {
        for (Index f = 0; f < n.mesh.face_count(); ++f) {
            const Vec3 a = area_vector(n.mesh, f);
            const std::array<double, 3> size{std::abs(a.x), std::abs(a.y), std::abs(a.z)};
            axes_.push_back(
                static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin()));
        }
        before_ = now();
    }

    /// True if each corner turns as before, so that no face was reversed or lost its area. Straight corners
    /// of larger faces may turn either way.
    bool are_kept() const {
        const std::vector<int> after = now();
        for (std::size_t i = 0; i < after.size(); ++i)
            if (after[i] != before_[i] && (before_[i] != 0 || of_triangle_[i])) return false;
        return true;
    }

  private:
    std::vector<int> now() const {
        std::vector<int> turns;
        of_triangle_.clear();
        const Mesh& mesh = n_.mesh;
        for (Index f = 0; f < mesh.face_count(); ++f) {
            if (!n_.around[f]) continue;
            const std::size_t u = (axes_[f] + 1) % 3, v = (axes_[f] + 2) % 3;
            for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
                const Vec3 &p = mesh.point(previous_corner(mesh, f, c)), &q = mesh.point(c),
                           &r = mesh.point(next_corner(mesh, f, c));
                turns.push_back(orientation_2d(p[u], p[v], q[u], q[v], r[u], r[v]));
                of_triangle_.push_back(mesh.face_size(f) == 3);
            }
        }
        return turns;
    }

    const Neighbourhood& n_;
    std::vector<std::size_t> axes_; ///< [faces] projection axis
    std::vector<int> before_;
    mutable std::vector<std::uint8_t> of_triangle_;
};

class Separation {
  public:
    explicit Separation(Work& work)
        : work_(work), mesh_(work.mesh), step_(float_step_of(work.mesh)),
          corners_(corners_at_vertices(work.mesh)), faces_(corner_faces(work.mesh)), tree_(padded_boxes()) {}

    /// lowest: result of lowest_at_place.
    bool run(const std::vector<Index>& lowest) {
        std::map<Index, std::vector<Index>> places;
        for (Index v = 0; v < lowest.size(); ++v)
            if (!corners_.of(v).empty()) places[lowest[v]].push_back(v);
        std::size_t moved = 0, untried = 0;
        Vec3 first_untried;
        for (const auto& [_, vertices] : places) {
            if (vertices.size() == 1) continue;
            const Vec3 at = mesh_.positions[vertices[0]];
            std::size_t there = vertices.size(); // the first vertex stays, if the others can be moved
            const bool was_stuck = work_.stuck.contains({at.x, at.y, at.z});
            for (auto v = vertices.rbegin(); v != vertices.rend() && there > 1 && !was_stuck && !is_spent();
                 ++v)
                there -= move(*v);
            moved += vertices.size() - there;
            if (there == 1) continue;
            if (is_spent() && !was_stuck) {
                if (untried++ == 0) first_untried = at;
                continue;
            }
            work_.stuck.insert({at.x, at.y, at.z});
            tell(at);
        }
        if (untried > 0) tell_of_untried(untried, first_untried);
        work_.counts.moved_apart += moved;
        return moved > 0;
    }

  private:
    std::vector<Box> padded_boxes() const {
        std::vector<Box> boxes(mesh_.face_count());
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c) boxes[f].add(mesh_.point(c));
            boxes[f] = grown(boxes[f], reach());
        }
        return boxes;
    }
    /// An upper bound of the movement along an axis.
    double reach() const { return (most_float_steps + 1) * step_; }

    Neighbourhood neighbourhood(Index v) const {
        Box box;
        for (const Index c : corners_.of(v))
            for (Index d = mesh_.face_begin(faces_[c]); d < mesh_.face_end(faces_[c]); ++d)
                box.add(mesh_.point(d));
        std::vector<Index> near;
        tree_.visit(grown(box, reach()), [&](Index f) { near.push_back(f); });
        std::sort(near.begin(), near.end());
        Neighbourhood n;
        std::map<Index, Index> number;
        n.mesh.face_offsets.push_back(0);
        for (const Index f : near) {
            n.around.push_back(0);
            for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c) {
                const Index w = mesh_.vertex(c);
                const auto [it, added] = number.emplace(w, static_cast<Index>(number.size()));
                if (added) n.mesh.positions.push_back(mesh_.positions[w]);
                n.mesh.corners.push_back(it->second);
                if (w == v) n.around.back() = 1;
            }
            n.mesh.face_offsets.push_back(static_cast<Index>(n.mesh.corners.size()));
        }
        normalise_offsets(n.mesh);
        n.vertex = number.at(v);
        return n;
    }

    /// Directions to try: the 26 along and between the axes, and along the mean normal of the vertex's
    /// faces. Others point to its neighbours and to the centres of its faces. Their longest coordinate is 1.
    /// Directions to the neighbours come first, because they pull the fan away from the others.
    std::vector<Vec3> directions(Index v) const {
        Vec3 towards, normal;
        std::vector<Vec3> all;
        for (const Index c : corners_.of(v)) {
            const Index f = faces_[c];
            const Vec3 &p = mesh_.positions[v], a = unit(mesh_.point(previous_corner(mesh_, f, c)) - p),
                       b = unit(mesh_.point(next_corner(mesh_, f, c)) - p);
            towards += a + b;
            normal += unit(cross(b, a));
            all.insert(all.end(), {a, a + b});
        }
        all.insert(all.end(), {towards, normal, normal * -1.0});
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z)
                    all.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
        for (Vec3& d : all) d = d / std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        std::erase_if(all, [](const Vec3& d) { return !is_finite(d); });
        std::stable_sort(all.begin(), all.end(), [&](const Vec3& a, const Vec3& b) {
            return dot(a, towards) / length(a) > dot(b, towards) / length(b);
        });
        return all;
    }
    /// Zero for a vector without direction.
    static Vec3 unit(const Vec3& a) {
        const Vec3 n = normalised(a);
        return is_finite(n) ? n : Vec3{};
    }

    /// Moves the vertex by the smallest valid number of steps, at most an eighth of its shortest edge.
    bool move(Index v) {
        Neighbourhood near = neighbourhood(v);
        const Meetings before = near.meetings();
        const Turns turns(near);
        const std::vector<Vec3> ways = directions(v);
        const Vec3 from = mesh_.positions[v];
        const double most = std::min(shortest_edge(v) / 8, most_float_steps * step_);
        for (int steps = fewest_float_steps; steps * step_ <= most; steps *= 2)
            for (const Vec3& d : ways) {
                if (is_spent()) return false;
                work_.budget.apart -= std::min(work_.budget.apart, near.mesh.face_count());
                const Vec3 to = as_float32(from + d * (steps * step_));
                if (!is_sound(near, turns, before, to)) continue;
                mesh_.positions[v] = to;
                work_.counts.farthest_apart = std::max(work_.counts.farthest_apart, length(to - from));
                return true;
            }
        return false;
    }
    bool is_spent() const { return work_.budget.apart == 0; }

    double shortest_edge(Index v) const {
        double least = HUGE_VAL;
        for (const Index c : corners_.of(v)) {
            const Index f = faces_[c];
            for (const Index d : {previous_corner(mesh_, f, c), next_corner(mesh_, f, c)})
                least = std::min(least, length(mesh_.point(d) - mesh_.positions[v]));
        }
        return least;
    }

    /// True if the vertex may move to this position. No other vertex may be at this position, and no face
    /// may be reversed or lose its area. No new pair of faces may intersect or touch.
    static bool is_sound(Neighbourhood& near, const Turns& turns, const Meetings& before, const Vec3& to) {
        if (!is_finite(to)) return false;
        const auto& all = near.mesh.positions;
        if (std::find(all.begin(), all.end(), to) != all.end()) return false;
        const Vec3 from = std::exchange(near.mesh.positions[near.vertex], to);
        bool sound = turns.are_kept();
        if (sound) {
            const Meetings after = near.meetings();
            sound = std::includes(before.crossing.begin(), before.crossing.end(), after.crossing.begin(),
                                  after.crossing.end()) &&
                    std::includes(before.all.begin(), before.all.end(), after.all.begin(), after.all.end());
        }
        near.mesh.positions[near.vertex] = from;
        return sound;
    }

    void tell_of_untried(std::size_t places, const Vec3& first) {
        work_.not_done.push_back(
            {"apart",
             fmt::format(
                 "vertices at {} were not moved apart, because this would take too long; STL will join them",
                 counted(places, "place")),
             first});
    }

    void tell(const Vec3& at) {
        work_.not_done.push_back(
            {"apart",
             fmt::format("vertices at the same position cannot be moved apart: each move of at most {} steps "
                         "of float32 and an eighth of their shortest edges would invert a face or make it "
                         "meet another; STL will join them",
                         most_float_steps),
             at});
    }

    Work& work_;
    Mesh& mesh_;
    double step_;
    VertexLists corners_;
    std::vector<Index> faces_; ///< [corners] faces
    BoxTree tree_;
};

} // namespace

bool move_apart(Work& work) {
    const std::vector<Index> lowest = lowest_at_place(work.mesh);
    return !are_distinct(lowest) && Separation(work).run(lowest);
}

} // namespace facetmill::clean_steps
