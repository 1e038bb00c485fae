// The clean steps that remove faces and vertices.
#include "geometry/clean/steps.hpp"
#include "geometry/edit/surgery.hpp"
#include "geometry/inspect/evidence.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/spatial/components_around.hpp"
#include "mesh/face.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <span>

namespace facetmill::clean_steps {

namespace {

/// Removes corners that repeat the vertex before them, and flags faces with fewer than three corners left.
std::size_t drop_repeated_corners(Mesh& mesh, std::vector<std::uint8_t>& gone) {
    if (mesh.all_triangles()) return 0; // a triangle that repeats a vertex has no area
    std::vector<Index> corners, offsets{0};
    std::size_t dropped = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
        const std::size_t first = corners.size();
        for (Index c = begin; c < end; ++c)
            if (mesh.vertex(c) != mesh.vertex(previous_corner(c, begin, end)))
                corners.push_back(mesh.corners[c]);
        if (corners.size() - first <
            3) { // a face without area: removed as a whole later, and unchanged until then
            corners.resize(first);
            corners.insert(corners.end(), mesh.corners.begin() + begin, mesh.corners.begin() + end);
            gone[f] = 1;
        } else {
            dropped += end - begin - (corners.size() - first);
        }
        offsets.push_back(static_cast<Index>(corners.size()));
    }
    mesh.corners = std::move(corners);
    mesh.face_offsets = std::move(offsets);
    normalise_offsets(mesh);
    return dropped;
}

std::vector<Index> sorted_vertices(const Mesh& mesh, Index f) {
    std::vector<Index> set;
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) set.push_back(mesh.vertex(c));
    std::sort(set.begin(), set.end());
    return set;
}

/// True if g has the same orientation as f. Both have the same set of vertices.
bool same_way(const Mesh& mesh, Index f, Index g) {
    const Index a = mesh.vertex(mesh.face_begin(f)), b = mesh.vertex(mesh.face_begin(f) + 1);
    for (Index c = mesh.face_begin(g); c < mesh.face_end(g); ++c)
        if (mesh.vertex(c) == a) return mesh.vertex(next_corner(mesh, g, c)) == b;
    return false;
}

/// How skins and morph targets move the corners of faces.
class Moves {
  public:
    explicit Moves(const Mesh& mesh) : mesh_(mesh) {
        for (const Attribute& a : mesh.attributes)
            if (a.role == Role::morph_vector || a.role == Role::joints || a.role == Role::weights)
                attributes_.push_back(&a);
    }
    /// The numbers of the face's corners, ordered by vertex.
    std::vector<double> of(Index f) const {
        std::vector<double> all;
        if (attributes_.empty()) return all;
        std::vector<Index> wedges(mesh_.face_wedges(f).begin(), mesh_.face_wedges(f).end());
        std::sort(wedges.begin(), wedges.end(), [&](Index a, Index b) {
            return std::pair(mesh_.vertex_of_wedge(a), a) < std::pair(mesh_.vertex_of_wedge(b), b);
        });
        for (const Index w : wedges)
            for (const Attribute* a : attributes_)
                for (int c = 0; c < a->components; ++c)
                    all.push_back(a->value(a->domain == Domain::vertex ? mesh_.vertex_of_wedge(w) : w, c));
        return all;
    }

  private:
    const Mesh& mesh_;
    std::vector<const Attribute*> attributes_;
};

/// The faces of every set of two or more with the same vertices in all poses, ordered by lowest face.
std::vector<std::vector<Index>> groups_of_duplicates(const Mesh& mesh) {
    std::vector<std::uint8_t> listed(mesh.face_count(), 0);
    const Moves moves(mesh);
    const auto key_of = [&](Index f) { return std::pair(sorted_vertices(mesh, f), moves.of(f)); };
    std::map<std::pair<std::vector<Index>, std::vector<double>>, std::vector<Index>> groups;
    for (const Index f : duplicate_faces(mesh)) {
        groups[key_of(f)].push_back(f);
        listed[f] = 1;
    }
    if (groups.empty()) return {};
    for (Index f = 0; f < mesh.face_count(); ++f) { // the first face of each set
        if (listed[f]) continue;
        const auto at = groups.find(key_of(f));
        if (at != groups.end()) at->second.push_back(f);
    }
    std::vector<std::vector<Index>> lists;
    for (auto& [set, faces] : groups) {
        if (faces.size() < 2) continue;
        std::sort(faces.begin(), faces.end());
        lists.push_back(std::move(faces));
    }
    std::sort(lists.begin(), lists.end());
    return lists;
}

/// For each edge, the number of faces that run from low to high minus the others.
std::vector<int> balances(const Mesh& mesh, const EdgeTable& edges) {
    std::vector<int> balance(edges.size(), 0);
    for (Index e = 0; e < edges.size(); ++e)
        for (const Index c : edges.corners_of(e)) balance[e] += mesh.vertex(c) == edges.edges[e].low ? 1 : -1;
    return balance;
}

/// Flags the cancelling faces whose patch is attached to other faces along edges. If the mesh is closed, a
/// common vertex is enough, because keeping one side would leave a boundary.
std::vector<std::uint8_t> stands_on_others(const Mesh& mesh, const EdgeTable& edges, bool closed,
                                           const std::vector<std::uint8_t>& cancels) {
    const auto faces = corner_faces(mesh);
    DisjointSets patches(mesh.face_count());
    std::vector<std::uint8_t> touches(mesh.face_count(), 0);
    const auto look_at = [&](std::span<const Index> corners) {
        Index first = none;
        bool others = false;
        for (const Index c : corners) {
            if (!cancels[faces[c]])
                others = true;
            else if (first == none)
                first = faces[c];
            else
                patches.join(first, faces[c]);
        }
        if (first != none && others) touches[first] = 1;
    };
    for (Index e = 0; e < edges.size(); ++e) look_at(edges.corners_of(e));
    const auto at_vertices = corners_at_vertices(mesh);
    for (Index v = 0; closed && v < mesh.vertex_count(); ++v) look_at(at_vertices.of(v));
    std::vector<std::uint8_t> stands(mesh.face_count(), 0);
    for (Index f = 0; f < touches.size(); ++f)
        if (touches[f]) stands[patches.find(f)] = 1;
    for (Index f = 0; f < stands.size(); ++f) stands[f] = cancels[f] && stands[patches.find(f)];
    return stands;
}

/// Faces with the same vertices. ways: faces oriented like the first minus the others.
struct Doubles {
    std::vector<Index> faces;
    int ways = 0;
};

/// Flags the sets that keep all faces left after cancelling, instead of one. They do if the surrounding
/// faces occur equally often, because a single face would leave boundary edges. Decided for connected
/// patches of sets.
std::vector<std::uint8_t> stay_many(const Mesh& mesh, const EdgeTable& edges, const std::vector<int>& balance,
                                    const std::vector<Doubles>& all) {
    DisjointSets patches(all.size());
    std::map<Index, std::pair<std::size_t, int>> excess; // per edge: a set, and its excess balance
    for (std::size_t g = 0; g < all.size(); ++g) {
        if (std::abs(all[g].ways) < 2) continue;
        const int more = all[g].ways > 0 ? all[g].ways - 1 : all[g].ways + 1;
        const Index f = all[g].faces[0];
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
            const Index e = edges.corner_edge[c];
            if (e == none) continue;
            const auto [at, fresh] = excess.try_emplace(e, g, 0);
            if (!fresh) patches.join(static_cast<Index>(at->second.first), static_cast<Index>(g));
            at->second.second += mesh.vertex(c) == edges.edges[e].low ? more : -more;
        }
    }
    std::vector<int> better(
        all.size(), 0); // [patches] boundary edges if one face stays, minus boundary edges if all stay
    for (const auto& [e, x] : excess)
        better[patches.find(static_cast<Index>(x.first))] += (balance[e] != x.second) - (balance[e] != 0);
    std::vector<std::uint8_t> many(all.size());
    for (std::size_t g = 0; g < all.size(); ++g)
        many[g] = std::abs(all[g].ways) > 1 && better[patches.find(static_cast<Index>(g))] > 0;
    return many;
}

} // namespace

bool remove_degenerate(Work& work) {
    std::vector<std::uint8_t> gone(work.mesh.face_count(), 0);
    const std::size_t repeated = drop_repeated_corners(work.mesh, gone);
    parallel_for(gone.size(), [&](std::size_t f) {
        if (is_degenerate(work.mesh, static_cast<Index>(f))) gone[f] = 1;
    });
    const auto kept = faces_without(gone);
    const std::size_t count = gone.size() - kept.size();
    work.counts.repeated_corners += repeated;
    work.counts.degenerate_faces += count;
    if (count > 0) {
        work.mesh = keep_faces(work.mesh, kept);
        const std::size_t before = work.counts.t_junctions;
        resolve_t_junctions(work, 0);
        work.counts.t_junctions = before;
    }
    return repeated + count > 0;
}

bool remove_duplicates(Work& work, bool walls) {
    const Mesh& mesh = work.mesh;
    std::vector<Doubles> all;
    for (auto& group : groups_of_duplicates(mesh)) all.push_back({std::move(group)});
    if (all.empty()) return false;
    const auto edges = build_edges(mesh);
    const auto balance = balances(mesh, edges);
    const bool closed = std::all_of(balance.begin(), balance.end(), [](int b) { return b == 0; });
    std::vector<std::uint8_t> cancels(mesh.face_count(), 0), gone(mesh.face_count(), 0);
    for (Doubles& d : all) {
        for (const Index f : d.faces) d.ways += same_way(mesh, d.faces[0], f) ? 1 : -1;
        for (const Index f : d.faces) cancels[f] = d.ways == 0;
    }
    const auto stands = stands_on_others(mesh, edges, closed, cancels);
    const auto many = stay_many(mesh, edges, balance, all);
    const bool beside = closed && std::count(cancels.begin(), cancels.end(), 0) > 0;
    std::size_t count = 0;
    for (std::size_t g = 0; g < all.size(); ++g) {
        const Index first = all[g].faces[0];
        const bool sheet = cancels[first] && !stands[first];
        int left[2]; // remaining faces with the opposite and with the same orientation as the first
        left[all[g].ways >= 0] = sheet || !cancels[first] ? (many[g] ? std::abs(all[g].ways) : 1) : 0;
        left[all[g].ways < 0] = sheet && beside ? 1 : 0;
        if (!walls) // both sides are seen
            for (int& side : left) side = std::max(side, 1);
        for (const Index f : all[g].faces) {
            gone[f] = left[same_way(mesh, first, f)]-- <= 0;
            count += gone[f];
        }
        if (walls && sheet && beside)
            work.not_done.push_back({"duplicates",
                                     "both sides of a separate sheet next to closed components are kept, "
                                     "because a single side would be open; components removes small sheets",
                                     mesh.point(mesh.face_begin(first))});
    }
    if (count == 0) return false;
    work.counts.duplicate_faces += count;
    work.mesh = keep_faces(mesh, faces_without(gone));
    return true;
}

namespace {

/// Removes components together with their faces, and adds both to the counts.
template <class Goes>
bool remove_where(Work& work, const Components& components, Goes&& goes, std::size_t& count,
                  std::size_t& faces) {
    std::size_t going = 0;
    for (Index p = 0; p < components.count; ++p) going += goes(p) ? 1 : 0;
    if (going == 0) return false;
    std::vector<std::uint8_t> gone(work.mesh.face_count());
    for (Index f = 0; f < gone.size(); ++f) gone[f] = goes(components.of_face[f]);
    const auto kept = faces_without(gone);
    count += going;
    faces += gone.size() - kept.size();
    work.mesh = keep_faces(work.mesh, kept);
    return true;
}

} // namespace

bool remove_components(Work& work, const ComponentSettings& s) {
    const Mesh& mesh = work.mesh;
    const Components components = face_components(mesh, false);
    struct Component {
        std::size_t faces = 0;
        double area = 0;
        Box box;
        bool goes = false;
    };
    std::vector<Component> all(components.count);
    double whole = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        Component& p = all[components.of_face[f]];
        const double area = length(area_vector(mesh, f)) / 2;
        ++p.faces;
        p.area += area;
        whole += area;
        add_corners(p.box, mesh, f);
    }
    for (Component& p : all)
        p.goes = p.faces < s.min_faces || p.box.diagonal() < s.min_size || p.area < s.min_area * whole;
    if (s.keep > 0 && all.size() > s.keep) {
        std::vector<std::size_t> order(all.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return all[a].area > all[b].area; });
        for (std::size_t i = s.keep; i < order.size(); ++i) all[order[i]].goes = true;
    }
    for (const Component& p : all)
        if (p.goes) work.counts.component_area += p.area;
    return remove_where(
        work, components, [&](Index p) { return all[p].goes; }, work.counts.components,
        work.counts.component_faces);
}

bool remove_isolated(Work& work) {
    std::vector<std::uint8_t> used(work.mesh.vertex_count(), 0);
    for (Index c = 0; c < work.mesh.corner_count(); ++c) used[work.mesh.vertex(c)] = 1;
    const auto isolated = static_cast<std::size_t>(std::count(used.begin(), used.end(), 0));
    if (isolated == 0) return false;
    work.counts.isolated_vertices += isolated;
    drop_unused(work.mesh);
    return true;
}

// The clean step that removes components hidden inside others.

namespace {

/// Flags components that are closed: the directions of their faces cancel at every edge.
std::vector<std::uint8_t> closed_components(const Mesh& mesh, const Components& components) {
    const auto edges = build_edges(mesh);
    const auto faces = corner_faces(mesh);
    std::vector<std::uint8_t> closed(components.count, 1);
    for (Index e = 0; e < edges.size(); ++e) {
        int balance = 0;
        for (const Index c : edges.corners_of(e)) balance += mesh.vertex(c) == edges.edges[e].low ? 1 : -1;
        if (balance != 0) closed[components.of_face[faces[edges.corners_of(e)[0]]]] = 0;
    }
    return closed;
}

} // namespace

bool remove_open_components(Work& work) {
    const Mesh& mesh = work.mesh;
    const Components components = face_components(mesh, false);
    const auto closed = closed_components(mesh, components);
    if (std::count(closed.begin(), closed.end(), 1) == 0) return false; // nothing would be left
    return remove_where(
        work, components, [&](Index p) { return !closed[p]; }, work.counts.open_components,
        work.counts.open_component_faces);
}

bool remove_inner_components(Work& work) {
    const Mesh& mesh = work.mesh;
    const Components components = face_components(mesh, false); // all edges connect components
    if (components.count < 2) return false;
    const auto closed = closed_components(mesh, components);
    std::set<std::pair<Index, Index>> touching;
    constexpr std::size_t max_pairs = std::size_t{1} << 24;
    for (const auto& [f, g] : find_self_intersections(mesh, {.limit = max_pairs}).pairs) {
        const Index a = components.of_face[f], b = components.of_face[g];
        touching.emplace(std::min(a, b), std::max(a, b));
    }
    std::vector<Index> first(components.count, none);
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (first[components.of_face[f]] == none) first[components.of_face[f]] = f;
    const FaceTree rays(surface_of(mesh), FaceTree::Use::rays);
    std::vector<std::uint8_t> inside(components.count, 0);
    for (Index p = 0; p < components.count; ++p) {
        if (!closed[p]) continue;
        const auto around = components_around(rays, mesh.point(mesh.face_begin(first[p])), components.of_face,
                                              [&](Index q) { return q != p && closed[q]; });
        for (const Index q : around)
            if (!touching.contains({std::min(p, q), std::max(p, q)})) inside[p] = 1;
    }
    return remove_where(
        work, components, [&](Index p) { return inside[p] != 0; }, work.counts.inner_components,
        work.counts.inner_component_faces);
}

} // namespace facetmill::clean_steps
