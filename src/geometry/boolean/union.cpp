// The clean step that unites closed components which intersect each other or themselves.
#include "geometry/boolean/solids.hpp"
#include "geometry/boolean/trial.hpp"
#include "geometry/clean/steps.hpp"
#include "geometry/edit/around_edge.hpp"
#include "geometry/inspect/evidence.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace facetmill::clean_steps {

namespace {

/// Limits the attempts for hostile input. After each attempt, clusters that cannot be united are excluded.
constexpr int max_trials = 8;

} // namespace

bool unite_solids(Work& work, SelfIntersections found, const std::vector<std::pair<Index, Index>>& overlaps,
                  const CleanSettings& settings) {
    Solids solids = find_solids(work.mesh, found);
    if (!overlaps.empty()) {
        for (const auto& [f, g] : overlaps) // overlaps of components that are not closed are ignored
            if (solids.closed[solids.components.of_face[f]] && solids.closed[solids.components.of_face[g]])
                found.pairs.emplace_back(f, g);
        std::sort(found.pairs.begin(), found.pairs.end());
        found.pairs.erase(std::unique(found.pairs.begin(), found.pairs.end()), found.pairs.end());
        solids = find_solids(work.mesh, found);
    }
    bool left = !solids.unfit.empty();
    for (NotDone& n : solids.unfit) work.not_done.push_back(std::move(n));
    const auto any = [&] {
        return std::any_of(solids.cluster.begin(), solids.cluster.end(), [](Index c) { return c != none; });
    };
    for (int trials = 0; any(); ++trials) {
        if (trials == max_trials || !work.may_process(found.pairs.size())) {
            for (Index c = 0; c < solids.clusters(); ++c)
                if (std::find(solids.cluster.begin(), solids.cluster.end(), c) != solids.cluster.end())
                    work.not_done.push_back(
                        {"self_intersections",
                         "not tried, because too many other components of the part could not be united",
                         solids.at[c]});
            break;
        }
        Trial trial(work, solids, settings);
        Failures failures = trial.run(found);
        work.short_of_memory |= trial.is_short_of_memory();
        std::size_t crowded = 0;
        if (failures.empty()) failures = trial.open_clusters(crowded);
        if (failures.empty()) {
            auto not_done = std::move(work.not_done);
            const UntangleBudget budget = work.budget;
            const bool short_of_memory = work.short_of_memory;
            work = trial.finish();
            work.budget = budget;
            work.short_of_memory = short_of_memory;
            work.counts.touching_edges += crowded;
            work.untangled = !left;
            work.not_done = std::move(not_done);
            return true;
        }
        left = true;
        work.processed_in_vain(found.pairs.size());
        for (auto& [cluster, why] : failures) {
            work.not_done.push_back({"self_intersections", std::move(why), solids.at[cluster]});
            for (Index& c : solids.cluster)
                if (c == cluster) c = none;
        }
    }
    return false;
}

// Triangles without area: rounding creates them from pieces of a union.

namespace {

/// The corner opposite the longest side of a collinear triangle; empty if corners have the same position.
std::optional<Index> middle_corner(const Mesh& mesh, Index f) {
    const Index begin = mesh.face_begin(f);
    std::array<Index, 3> c{begin, begin + 1, begin + 2};
    Box box;
    add_corners(box, mesh, f);
    const Vec3 extent = box.extent();
    const std::size_t axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    std::sort(c.begin(), c.end(),
              [&](Index i, Index j) { return mesh.point(i)[axis] < mesh.point(j)[axis]; });
    const bool apart =
        mesh.point(c[0])[axis] < mesh.point(c[1])[axis] && mesh.point(c[1])[axis] < mesh.point(c[2])[axis];
    return apart ? std::optional(c[1]) : std::nullopt;
}

/// A round of removing flat triangles and splitting edges. Each face is processed once.
struct Round {
    std::vector<std::uint8_t> goes;
    std::vector<Insertion> insertions;
    std::vector<Index> cut; ///< triangles that are split in two, ascending
};

Round plan(const Mesh& mesh) {
    Round round;
    std::vector<Index> flat;
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (mesh.face_size(f) == 3 && is_degenerate(mesh, f)) flat.push_back(f);
    if (flat.empty()) return round;
    round.goes.assign(mesh.face_count(), 0);
    const auto edges = build_edges(mesh);
    const auto faces = corner_faces(mesh);
    std::vector<std::uint8_t> busy(mesh.face_count(), 0);
    for (const Index f : flat) {
        const auto middle = middle_corner(mesh, f);
        if (!middle || busy[f]) continue;
        const Index from = next_corner(mesh, f, *middle), e = edges.corner_edge[from];
        if (e == none) continue;
        for (const Index c : edges.corners_of(e)) {
            const Index g = faces[c];
            if (mesh.vertex(c) == mesh.vertex(from) || busy[g] || g == f) continue;
            const Vec3 &a = mesh.point(c), &b = mesh.point(next_corner(mesh, g, c));
            const double t = length(mesh.point(*middle) - a) / length(b - a);
            round.insertions.push_back({c, t, mesh.vertex(*middle)});
            if (mesh.face_size(g) == 3) round.cut.push_back(g);
            busy[f] = busy[g] = 1;
            round.goes[f] = 1;
            break;
        }
    }
    std::sort(round.cut.begin(), round.cut.end());
    return round;
}

} // namespace

void take_out_flat(Work& work) {
    constexpr int max_rounds = 64;
    for (int i = 0; i < max_rounds; ++i) {
        Round round = plan(work.mesh);
        if (round.insertions.empty()) return;
        std::vector<std::uint8_t> goes(round.goes.size() + round.cut.size(), 0);
        std::size_t before = 0; // triangles split in two, below f
        for (Index f = 0; f < round.goes.size(); ++f) {
            goes[f + before] = round.goes[f];
            if (before < round.cut.size() && round.cut[before] == f) ++before;
        }
        work.mesh = insert_on_edges(work.mesh, std::move(round.insertions), {}, &work.changes);
        work.mesh = keep_faces(work.mesh, faces_without(goes));
    }
}

// Solids that overlap and yet meet only in edges, for example grids that cross along their lines.

namespace {

/// True if two leaves, adjacent in the order around the edge, have the same angle.
bool same_angle(const Vec3& u, const Vec3& v, const EdgeLeaf& a, const EdgeLeaf& b) {
    return a.half == b.half && (a.half % 2 == 0 || orientation_3d(u, v, a.beside, b.beside) == 0);
}

/// True if the winding number takes more than two values around the edge.
bool winds_twice(const Vec3& u, const Vec3& v, std::vector<EdgeLeaf> leaves) {
    sort_around_edge(u, v, leaves);
    int winding = 0, least = 0, most = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        winding += leaves[i].forward ? -1 : 1; // the inside is before a forward face
        if (i + 1 < leaves.size() && same_angle(u, v, leaves[i], leaves[i + 1])) continue;
        least = std::min(least, winding);
        most = std::max(most, winding);
    }
    return winding == 0 && most - least > 1;
}

} // namespace

std::vector<std::pair<Index, Index>> overlaps_at_edges(const Mesh& mesh) {
    Mesh plain; // vertices at the same position are merged
    plain.positions = mesh.positions;
    plain.face_offsets = mesh.face_offsets;
    const auto place = lowest_at_place(mesh);
    for (Index c = 0; c < mesh.corner_count(); ++c) plain.corners.push_back(place[mesh.vertex(c)]);
    const auto edges = build_edges(plain);
    std::vector<std::pair<Index, Index>> pairs;
    std::vector<Index> faces;
    for (Index e = 0; e < edges.size(); ++e) {
        const auto corners = edges.corners_of(e);
        if (corners.size() < 4) continue;
        if (faces.empty()) faces = corner_faces(plain);
        const auto& [low, high] = edges.edges[e];
        std::vector<EdgeLeaf> leaves;
        for (const Index c : corners)
            leaves.push_back({c, beside_edge(plain, faces[c], c), plain.vertex(c) == low});
        if (!winds_twice(plain.positions[low], plain.positions[high], std::move(leaves))) continue;
        for (std::size_t i = 0; i + 1 < corners.size();
             ++i) // compares adjacent pairs only, because all pairs could be too many
            if (faces[corners[i]] != faces[corners[i + 1]])
                pairs.push_back(std::minmax({faces[corners[i]], faces[corners[i + 1]]}));
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

std::vector<std::pair<Index, Index>> overlaps_at_edges(const Mesh& mesh, const Rings& rings,
                                                       const LooseEdges& edges) {
    const auto is_crowded = [&](Index e) { return edges.corners_of(e).size() > 2; };
    if (!rings.empty()) { // rings are known only if all positions are distinct
        bool any = false;
        for (Index e = 0; e < edges.size(); ++e) any |= is_crowded(e);
        if (!any) return {};
    }
    const auto place = lowest_at_place(mesh);
    std::vector<std::uint8_t> is_shared(
        mesh.vertex_count(), 0); // 1 for positions shared by several vertices, or at a crowded edge
    for (Index v = 0; v < place.size(); ++v)
        if (place[v] != v) is_shared[place[v]] = 1;
    const auto face_of = corner_faces(mesh);
    for (Index e = 0; e < edges.size(); ++e) {
        if (!is_crowded(e)) continue;
        const Index c = edges.corners_of(e)[0];
        is_shared[place[mesh.vertex(c)]] = is_shared[place[mesh.vertex(next_corner(mesh, face_of[c], c))]] =
            1;
    }
    std::vector<Index> faces;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        int count = 0;
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            count += is_shared[place[mesh.vertex(c)]];
        if (count > 1) faces.push_back(f);
    }
    auto pairs = overlaps_at_edges(only_faces(mesh, faces));
    for (auto& [f, g] : pairs) {
        f = faces[f];
        g = faces[g];
    }
    return pairs;
}

} // namespace facetmill::clean_steps
