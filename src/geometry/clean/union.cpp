// The step of clean that makes one solid of closed pieces that pass through each other or themselves.
#include "geometry/clean/solids.hpp"
#include "geometry/clean/united.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace facetmill::clean_steps {

namespace {

constexpr int most_passes = 8;
/// Those that cannot be united are left out and the rest is tried again, so often: a bound for what is
/// hostile.
constexpr int most_trials = 8;
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
        for (Index p = 0; p < solids_.pieces.count; ++p)
            work_.counts.united_components += solids_.cluster[p] != none;
        SelfIntersections found = first;
        double within = 0;
        Solids solids = solids_;
        for (int pass = 0; pass < most_passes; ++pass) {
            if (!one_pass(solids, found, within)) return std::move(failures_);
            within = within > 0 ? 8 * within : nearest * work_.mesh.bounds().diagonal();
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
                                 most_passes));
        return std::move(failures_);
    }

    const Mesh& mesh() const { return work_.mesh; }
    Work finish() {
        work_.mesh.drop(mark_name, Domain::face);
        forget_change(work_.changes, mark_name);
        return std::move(work_);
    }

  private:
    void fail(std::uint32_t mark, std::string why) {
        if ((mark & ~fresh) != 0) failures_.try_emplace((mark & ~fresh) - 1, std::move(why));
    }

    bool one_pass(const Solids& solids, const SelfIntersections& found, double within) {
        United united = unite(work_.mesh, solids, found, within);
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
        if (settings_.non_manifold) split_non_manifold(work_);
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
                else if (!solids.closed[solids.pieces.of_face[one]])
                    fail(marks[one], "the union, rounded, would not be closed");
    }

    const CleanSettings& settings_;
    const Solids& solids_;
    Work work_;
    Failures failures_;
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
        for (const auto& [f, g] : overlaps) // of pieces that are not closed they say nothing
            if (solids.closed[solids.pieces.of_face[f]] && solids.closed[solids.pieces.of_face[g]])
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
        if (trials == most_trials) {
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
        std::size_t crowded = 0;
        if (failures.empty()) failures = open_clusters(trial.mesh(), crowded);
        if (failures.empty()) {
            auto not_done = std::move(work.not_done);
            work = trial.finish();
            work.counts.touching_edges += crowded;
            work.untangled = !left;
            work.not_done = std::move(not_done);
            return true;
        }
        left = true;
        for (auto& [cluster, why] : failures) {
            work.not_done.push_back({"self_intersections", std::move(why), solids.at[cluster]});
            for (Index& c : solids.cluster)
                if (c == cluster) c = none;
        }
    }
    return false;
}

} // namespace facetmill::clean_steps
