// The clean step that replaces intersecting faces locally.
#include "geometry/clean/steps.hpp"
#include "geometry/edit/surgery.hpp"
#include "mesh/face.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>

namespace facetmill::clean_steps {

namespace {

constexpr int max_rings = 4;
/// An attempt takes time proportional to the mesh; most meshes need one per ring. After half of the
/// attempts, no region grows further.
constexpr int max_attempts = 32;

/// The edges of a single face as (low, high), ascending.
EdgeList boundary_of(const Mesh& mesh) {
    EdgeList list;
    for (const BoundaryEdge& e : boundary_edges(mesh)) list.push_back(std::minmax({e.from, e.to}));
    return list;
}

/// The Euler characteristic V - E + F of each group of faces, including boundaries.
std::map<Index, int> euler_of_groups(const Mesh& mesh, const std::vector<Index>& groups) {
    std::map<Index, int> euler;
    std::set<std::pair<Index, Index>> vertices; // pairs of group and vertex
    std::set<std::pair<Index, std::pair<Index, Index>>> edges;
    for (Index f = 0; f < groups.size(); ++f) {
        if (groups[f] == none) continue;
        ++euler[groups[f]];
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
            const Index a = mesh.vertex(c), b = mesh.vertex(next_corner(mesh, f, c));
            if (vertices.emplace(groups[f], a).second) ++euler[groups[f]];
            if (edges.emplace(groups[f], std::minmax({a, b})).second) --euler[groups[f]];
        }
    }
    return euler;
}

/// Connected intersecting faces, which are repaired or given up together.
struct Knot {
    std::vector<Index> faces;
    std::size_t pairs = 0;
    Vec3 at;
    int rings = 0; ///< rings of faces around them that are removed too
    bool given_up = false;
};

class Untangler {
  public:
    Untangler(Work& work, SelfIntersections found)
        : work_(work), mesh_(work.mesh), found_(std::move(found)), place_(lowest_at_place(work.mesh)),
          open_(boundary_of(work.mesh)), components_(face_components(work.mesh, false)),
          areas_(components_.count) {
        for (Index f = 0; f < mesh_.face_count(); ++f) areas_[components_.of_face[f]] += area(f);
        find_knots();
    }

    /// Widens the failed knots until the rest can be repaired together.
    bool run() {
        bool changed = false;
        while (std::any_of(knots_.begin(), knots_.end(), [](const Knot& k) { return !k.given_up; })) {
            const auto region = region_of_knots();
            const auto groups = groups_of(region);
            if (give_up_large(region, groups)) continue;
            if (attempts_ == max_attempts || !work_.may_process(found_.count)) {
                tell_of_untried();
                break;
            }
            ++attempts_;
            Work trial;
            const auto failed = replace(region, groups, trial);
            if (failed.empty()) {
                accept(region, std::move(trial));
                changed = true;
                break;
            }
            work_.processed_in_vain(found_.count);
            widen_or_give_up(failed, groups);
        }
        for (const Knot& k : knots_)
            if (k.given_up)
                work_.not_done.push_back(
                    {"self_intersections",
                     fmt::format("removing the faces of {} intersecting pairs would leave a hole that cannot "
                                 "be filled without new intersections, or that is half of the component",
                                 k.pairs),
                     k.at});
        return changed;
    }

  private:
    void tell_of_untried() {
        std::size_t pairs = 0;
        const Knot* first = nullptr;
        for (const Knot& k : knots_) {
            if (k.given_up) continue;
            pairs += k.pairs;
            if (!first) first = &k;
        }
        work_.not_done.push_back(
            {"self_intersections",
             fmt::format(
                 "{} intersecting pairs are left after {} attempts, and more attempts would take too long",
                 pairs, attempts_),
             first->at});
    }

    void widen_or_give_up(const std::set<Index>& failed, const std::vector<Index>& groups) {
        for (Knot& k : knots_)
            if (!k.given_up && failed.contains(groups[k.faces[0]]))
                k.given_up = ++k.rings > max_rings || attempts_ > max_attempts / 2;
    }

    double area(Index f) const { return length(area_vector(mesh_, f)) / 2; }
    Index place(Index corner) const { return place_[mesh_.vertex(corner)]; }

    /// A group number for each flagged face, equal for faces that share a position or intersect. none for
    /// other faces.
    std::vector<Index> groups_of(const std::vector<std::uint8_t>& flags) const {
        DisjointSets sets(mesh_.vertex_count());
        for (Index f = 0; f < flags.size(); ++f)
            for (Index c = mesh_.face_begin(f); flags[f] && c < mesh_.face_end(f); ++c)
                sets.join(place(mesh_.face_begin(f)), place(c));
        for (const auto& [f, g] : found_.pairs)
            if (flags[f] && flags[g]) sets.join(place(mesh_.face_begin(f)), place(mesh_.face_begin(g)));
        std::vector<Index> groups(flags.size(), none);
        for (Index f = 0; f < flags.size(); ++f)
            if (flags[f]) groups[f] = sets.find(place(mesh_.face_begin(f)));
        return groups;
    }

    void find_knots() {
        std::vector<std::uint8_t> flags(mesh_.face_count(), 0);
        for (const auto& [f, g] : found_.pairs) flags[f] = flags[g] = 1;
        const auto groups = groups_of(flags);
        std::map<Index, std::size_t> knot_of;
        for (Index f = 0; f < flags.size(); ++f) {
            if (!flags[f]) continue;
            const auto [at, fresh] = knot_of.try_emplace(groups[f], knots_.size());
            if (fresh) knots_.emplace_back();
            knots_[at->second].faces.push_back(f);
        }
        for (const auto& [f, g] : found_.pairs) {
            Knot& knot = knots_[knot_of.at(groups[f])];
            if (knot.pairs++ > 0) continue;
            knot.at = corner_mean(mesh_, f);
        }
    }

    /// The faces of the knots that are not given up, and of the rings around them.
    std::vector<std::uint8_t> region_of_knots() const {
        std::vector<std::uint8_t> reach(mesh_.face_count(), 0); // 1 more than the rings still to add
        for (const Knot& k : knots_)
            for (const Index f : k.faces)
                if (!k.given_up) reach[f] = static_cast<std::uint8_t>(k.rings + 1);
        for (int ring = 0; ring < max_rings; ++ring) {
            std::vector<std::uint8_t> at_place(mesh_.vertex_count(), 0);
            for (Index f = 0; f < reach.size(); ++f)
                for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c)
                    at_place[place(c)] = std::max(at_place[place(c)], reach[f]);
            for (Index f = 0; f < reach.size(); ++f)
                for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c)
                    if (at_place[place(c)] > reach[f] + 1)
                        reach[f] = static_cast<std::uint8_t>(at_place[place(c)] - 1);
        }
        return reach;
    }

    /// Gives up knots that would remove half of a component.
    bool give_up_large(const std::vector<std::uint8_t>& region, const std::vector<Index>& groups) {
        std::map<std::pair<Index, Index>, double> going; // removed area by group and component
        for (Index f = 0; f < region.size(); ++f)
            if (region[f]) going[{groups[f], components_.of_face[f]}] += area(f);
        std::set<Index> large;
        for (const auto& [key, sum] : going)
            if (!(sum < areas_[key.second] / 2)) large.insert(key.first);
        for (Knot& k : knots_)
            if (!k.given_up && large.contains(groups[k.faces[0]])) k.given_up = true;
        return !large.empty();
    }

    /// Removes the region from the mesh and fills the holes. Returns the groups where an open edge or an
    /// intersection remains.
    std::set<Index> replace(const std::vector<std::uint8_t>& region, const std::vector<Index>& groups,
                            Work& trial) const {
        const auto kept = faces_without(region);
        trial.mesh = keep_faces(mesh_, kept);
        std::vector<std::uint8_t> goes(mesh_.vertex_count(), 0); // 1 for vertices that lose all their faces
        std::vector<Index> group_of_vertex(mesh_.vertex_count(), none);
        for (Index f = 0; f < region.size(); ++f)
            for (Index c = mesh_.face_begin(f); region[f] && c < mesh_.face_end(f); ++c) {
                goes[mesh_.vertex(c)] = 1;
                group_of_vertex[mesh_.vertex(c)] = groups[f];
            }
        for (const Index f : kept)
            for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c) goes[mesh_.vertex(c)] = 0;
        std::vector<Index> number(mesh_.vertex_count(), none), group;
        for (Index v = 0; v < goes.size(); ++v)
            if (!goes[v]) {
                number[v] = static_cast<Index>(group.size());
                group.push_back(group_of_vertex[v]);
            }
        EdgeList before;
        for (const auto& [low, high] : open_)
            if (!goes[low] && !goes[high]) before.emplace_back(number[low], number[high]);
        fill_holes(trial, {}, &before, true);
        std::vector<Index> patches(trial.mesh.face_count(), none); // groups of the new faces
        for (auto f = static_cast<Index>(kept.size()); f < patches.size(); ++f)
            for (Index c = trial.mesh.face_begin(f); c < trial.mesh.face_end(f); ++c)
                if (trial.mesh.vertex(c) < group.size()) patches[f] = group[trial.mesh.vertex(c)];
        auto failed = failures(trial.mesh, before, group, patches, work_.max_box_pairs());
        // A patch must not cut a tube or close a handle: the new faces must have the topology of the old
        // ones.
        auto went = euler_of_groups(mesh_, groups), came = euler_of_groups(trial.mesh, patches);
        for (const auto& [g, euler] : went)
            if (came[g] != euler) failed.insert(g);
        return failed;
    }

    /// The groups whose patches have an open edge or an intersecting face. groups: the groups of the old
    /// vertices. patches: the groups of the new faces.
    static std::set<Index> failures(const Mesh& mesh, const EdgeList& before,
                                    const std::vector<Index>& groups, const std::vector<Index>& patches,
                                    std::size_t max_box_pairs) {
        std::set<Index> failed;
        for (const auto& edge : boundary_of(mesh))
            if (!std::binary_search(before.begin(), before.end(), edge)) failed.insert(groups[edge.first]);
        std::vector<std::uint8_t> among(patches.size());
        for (std::size_t f = 0; f < among.size(); ++f) among[f] = patches[f] != none;
        if (std::count(among.begin(), among.end(), 1) == 0) return failed;
        const SelfIntersections found = crossings(mesh, among, max_box_pairs);
        for (const Index group : patches)
            if (found.too_many && group != none) failed.insert(group);
        for (const auto& [f, g] : found.pairs)
            for (const Index face : {f, g})
                if (patches[face] != none) failed.insert(patches[face]);
        return failed;
    }

    void accept(const std::vector<std::uint8_t>& region, Work trial) {
        work_.counts.intersecting_faces += region.size() - faces_without(region).size();
        if (!trial.changes.empty()) work_.changes = std::move(trial.changes);
        work_.mesh = std::move(trial.mesh);
    }

    Work& work_;
    const Mesh mesh_; // the original, even after the work's mesh is replaced
    SelfIntersections found_;
    std::vector<Index> place_;
    EdgeList open_;
    Components components_;
    std::vector<double> areas_; ///< [components] areas
    std::vector<Knot> knots_;
    int attempts_ = 0;
};

} // namespace

bool resolve_self_intersections(Work& work, SelfIntersections found) {
    return found.count > 0 && Untangler(work, std::move(found)).run();
}

} // namespace facetmill::clean_steps
