// The step of clean that makes one solid of closed components that pass through each other or themselves.
#include "geometry/clean/solids.hpp"
#include "geometry/clean/steps.hpp"
#include "geometry/clean/united.hpp"
#include "geometry/edit/around_edge.hpp"
#include "geometry/inspect/evidence.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <optional>

namespace facetmill::clean_steps {

namespace {

constexpr int max_passes = 8;
/// Those that cannot be united are left out and the rest is tried again, so often: a bound for what is
/// hostile.
constexpr int max_trials = 8;
/// Where passes make new crossings, points that are this near (of the size of the mesh) become one, and eight
/// times as far in each pass after; in the first, only those that round to one place.
constexpr double nearest = 1.0 / static_cast<double>(std::int64_t{1} << 50);
/// Face attribute that tells, while this step works, the cluster (counted from 1) that a face came from, and
/// whether the last pass made it.
constexpr std::string_view mark_name = "facetmill:solid";
constexpr std::uint32_t fresh = std::uint32_t{1} << 31;

void put_marks(Mesh& mesh, const Solids& solids) {
    std::vector<std::uint32_t> marks(mesh.face_count());
    for (Index f = 0; f < marks.size(); ++f) marks[f] = solids.cluster_of_face(f) + 1; // none + 1 is 0
    mesh.attributes.push_back(
        {std::string(mark_name), Domain::face, Role::index, 1, false, AttributeData(std::move(marks))});
}

std::span<const std::uint32_t> marks_of(const Mesh& mesh) {
    return std::get<std::vector<std::uint32_t>>(mesh.find(mark_name, Domain::face)->data);
}

using Failures = std::map<Index, std::string>; ///< cluster -> why

/// The work on clusters that are tried together.
class Trial {
  public:
    Trial(const Work& work, const Solids& solids, const CleanSettings& settings)
        : settings_(settings), solids_(solids) {
        work_.mesh = work.mesh;
        work_.counts = work.counts;
        work_.changes = work.changes;
        put_marks(work_.mesh, solids);
    }

    /// The clusters that cannot be united, if any.
    Failures run(const SelfIntersections& first) {
        for (Index p = 0; p < solids_.components.count; ++p)
            work_.counts.united_components += solids_.cluster[p] != none;
        SelfIntersections found = first;
        double tolerance = 0;
        Solids solids = solids_;
        for (int pass = 0; pass < max_passes; ++pass) {
            if (!one_pass(solids, found, tolerance)) return std::move(failures_);
            tolerance = tolerance > 0 ? 8 * tolerance : nearest * work_.mesh.bounds().diagonal();
            tidy();
            found = crossings_of_fresh();
            if (found.pairs.empty()) return std::move(failures_);
            solids = find_solids(work_.mesh, found);
            check_marks(solids, found);
            if (!failures_.empty()) return std::move(failures_);
        }
        for (const auto& [f, g] : found.pairs)
            for (const Index face : {f, g})
                fail(marks_of(work_.mesh)[face],
                     fmt::format("the rounded coordinates of the union still intersect after {} passes",
                                 max_passes));
        return std::move(failures_);
    }

    const Mesh& mesh() const { return work_.mesh; }
    bool is_short_of_memory() const { return short_of_memory_; }
    Work finish() {
        work_.mesh.drop(mark_name, Domain::face);
        forget_change(work_.changes, mark_name);
        return std::move(work_);
    }

  private:
    void fail(std::uint32_t mark, const std::string& why) {
        if ((mark & ~fresh) != 0) failures_.try_emplace((mark & ~fresh) - 1, why);
    }

    bool one_pass(const Solids& solids, const SelfIntersections& found, double tolerance) {
        United united = unite(work_.mesh, solids, found, tolerance);
        short_of_memory_ |= united.short_of_memory;
        for (const auto& refused :
             united.refused) { // a cluster of this pass; its marks say which of the first
            for (Index f = 0; f < work_.mesh.face_count(); ++f)
                if (solids.cluster_of_face(f) == refused.cluster) fail(marks_of(work_.mesh)[f], refused.why);
        }
        if (!united.refused.empty()) return false;
        work_.mesh = std::move(united.mesh);
        work_.changes = std::move(united.changes);
        auto& marks = std::get<std::vector<std::uint32_t>>(work_.mesh.find(mark_name, Domain::face)->data);
        for (std::size_t f = 0; f < marks.size(); ++f)
            marks[f] = (marks[f] & ~fresh) | (f < united.uncut_faces ? 0 : fresh);
        work_.counts.refined_faces += united.cut_faces;
        work_.counts.covered_faces += united.covered_faces;
        return true;
    }

    /// What rounding left: equal points, faces without area or twice, and edges that four faces share.
    void tidy() {
        const CleanCounts before = work_.counts;
        if (settings_.weld != Nearness::off) weld_equal(work_, settings_.non_manifold);
        if (settings_.degenerate) {
            take_out_flat(work_);
            remove_degenerate(work_);
        }
        if (settings_.duplicates) remove_duplicates(work_);
        if (settings_.non_manifold) take_apart_non_manifold(work_);
        work_.counts = before; // a part of the union
    }

    /// Faces that are not fresh cross as little as they did before the last pass.
    SelfIntersections crossings_of_fresh() const {
        const auto marks = marks_of(work_.mesh);
        std::vector<std::uint8_t> among(marks.size());
        for (std::size_t f = 0; f < among.size(); ++f) among[f] = (marks[f] & fresh) != 0;
        SelfIntersections found = crossings(work_.mesh, std::move(among));
        std::erase_if(found.pairs, [&](const auto& pair) { // there before
            const auto m = marks[pair.first] & ~fresh, n = marks[pair.second] & ~fresh;
            return (m == 0 && solids_.meets_unfit[n - 1]) || (n == 0 && solids_.meets_unfit[m - 1]);
        });
        return found;
    }

    /// What intersects still must be of the clusters, closed and turned outward as before.
    void check_marks(const Solids& solids, const SelfIntersections& found) {
        const auto marks = marks_of(work_.mesh);
        for (const auto& [f, g] : found.pairs)
            for (const auto& [one, other] : {std::pair{f, g}, std::pair{g, f}})
                if ((marks[other] & ~fresh) == 0)
                    fail(marks[one], "the union, rounded, would intersect another component");
                else if (!solids.closed[solids.components.of_face[one]])
                    fail(marks[one], "the union, rounded, would not be closed");
    }

    const CleanSettings& settings_;
    const Solids& solids_;
    Work work_;
    Failures failures_;
    bool short_of_memory_ = false;
};

/// The clusters whose faces do not close any more; counts the edges of more than two faces of clusters.
Failures open_clusters(const Mesh& mesh, std::size_t& crowded) {
    Failures failures;
    crowded = 0;
    const auto marks = marks_of(mesh);
    const auto edges = build_edges(mesh);
    const auto faces = corner_faces(mesh);
    for (Index e = 0; e < edges.size(); ++e) {
        int balance = 0;
        for (const Index c : edges.corners_of(e)) balance += mesh.vertex(c) == edges.edges[e].low ? 1 : -1;
        const auto mark = marks[faces[edges.corners_of(e)[0]]] & ~fresh;
        crowded += mark != 0 && edges.corners_of(e).size() > 2;
        if (balance != 0 && mark != 0)
            failures.try_emplace(mark - 1, "the union, rounded, would not be closed");
    }
    return failures;
}

} // namespace

bool unite_solids(Work& work, SelfIntersections found, const std::vector<std::pair<Index, Index>>& overlaps,
                  const CleanSettings& settings) {
    Solids solids = find_solids(work.mesh, found);
    if (!overlaps.empty()) {
        for (const auto& [f, g] : overlaps) // of components that are not closed they say nothing
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
        if (failures.empty()) failures = open_clusters(trial.mesh(), crowded);
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

// Triangles without area, as rounding makes them of the pieces of a union.

namespace {

/// The corner opposite to the longest side of a triangle on a line; none where corners are at one place.
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

/// One round: triangles that go, and what is put where. Each face takes part once.
struct Round {
    std::vector<std::uint8_t> goes;
    std::vector<Insertion> insertions;
    std::vector<Index> cut; ///< triangles that become two, ascending
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
        std::size_t before = 0; // triangles that became two, below f
        for (Index f = 0; f < round.goes.size(); ++f) {
            goes[f + before] = round.goes[f];
            if (before < round.cut.size() && round.cut[before] == f) ++before;
        }
        work.mesh = insert_on_edges(work.mesh, std::move(round.insertions), {}, &work.changes);
        work.mesh = keep_faces(work.mesh, faces_without(goes));
    }
}

// Solids that overlap and yet meet in edges only: grids that cross along their lines.

namespace {

/// Whether two leaves, neighbours in the order around the edge, are at the same angle.
bool same_angle(const Vec3& u, const Vec3& v, const EdgeLeaf& a, const EdgeLeaf& b) {
    return a.half == b.half && (a.half % 2 == 0 || orientation_3d(u, v, a.beside, b.beside) == 0);
}

/// Whether the winding number takes more than two values around the edge.
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
    Mesh plain; // vertices at one place are one
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
        for (std::size_t i = 0; i + 1 < corners.size(); ++i) // a chain: all pairs could be too many
            if (faces[corners[i]] != faces[corners[i + 1]])
                pairs.push_back(std::minmax({faces[corners[i]], faces[corners[i + 1]]}));
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

} // namespace facetmill::clean_steps
