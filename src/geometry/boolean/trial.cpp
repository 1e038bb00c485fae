#include "geometry/boolean/trial.hpp"

#include "geometry/boolean/settled.hpp"
#include "mesh/topology.hpp"
#include "parallel/memory.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::clean_steps {

namespace {

constexpr int max_passes = 8;
constexpr const char* spreading = "rounding the coordinates of the union makes ever more faces intersect";
/// Merge distance, relative to the size of the mesh. The first pass merges only points that round to the same
/// position. If a pass makes new intersections, the second uses this distance, and each later pass eight
/// times the previous.
constexpr double nearest = 1.0 / static_cast<double>(std::int64_t{1} << 50);
/// The merge distance for 32-bit positions: their rounding error.
constexpr double nearest_single = 1.0 / static_cast<double>(std::int64_t{1} << 22);
/// Temporary face attribute: the cluster of a face (counted from 1), and a flag for faces made by the last
/// pass.
constexpr std::string_view mark_name = "facetmill:solid";
constexpr std::uint32_t fresh = std::uint32_t{1} << 31;

void put_marks(Mesh& mesh, const Solids& solids) {
    std::vector<std::uint32_t> marks(mesh.face_count());
    for (Index f = 0; f < marks.size(); ++f) marks[f] = solids.cluster_of_face(f) + 1; // `none` + 1 is 0
    mesh.attributes.push_back(
        {std::string(mark_name), Domain::face, Role::index, 1, false, AttributeData(std::move(marks))});
}

std::span<const std::uint32_t> marks_of(const Mesh& mesh) {
    return std::get<std::vector<std::uint32_t>>(mesh.find(mark_name, Domain::face)->data);
}

} // namespace

Trial::Trial(Work work, const Solids& solids, const CleanSettings& settings)
    : settings_(settings), solids_(solids) {
    work_.mesh = std::move(work.mesh);
    work_.counts = work.counts;
    work_.changes = std::move(work.changes);
    put_marks(work_.mesh, solids);
}

Failures Trial::run(const SelfIntersections& first, const Operands* operands) {
    for (Index p = 0; p < solids_.components.count; ++p)
        work_.counts.united_components += solids_.cluster[p] != none;
    is_operation_ = operands != nullptr;
    SelfIntersections found = first;
    double tolerance = 0;
    Solids later;
    for (int pass = 0; pass < max_passes; ++pass) {
        const Solids& solids = pass == 0 ? solids_ : later;
        if (!one_pass(solids, found, tolerance, pass == 0 ? operands : nullptr, effort(pass)))
            return std::move(failures_);
        tolerance = tolerance > 0
                        ? 8 * tolerance
                        : (settings_.single ? nearest_single : nearest) * work_.mesh.bounds().diagonal();
        if (!is_tidy_) tidy();
        found = crossings_of_fresh();
        if (found.pairs.empty()) return std::move(failures_);
        if (found.count > found.pairs.size()) {
            for (const std::uint32_t mark : marks_of(work_.mesh)) fail(mark, spreading);
            return std::move(failures_);
        }
        later = find_solids(work_.mesh, found);
        check_marks(later, found);
        if (!failures_.empty()) return std::move(failures_);
    }
    for (const auto& [f, g] : found.pairs)
        for (const Index face : {f, g})
            fail(marks_of(work_.mesh)[face],
                 fmt::format("the rounded coordinates of the union still intersect after {} passes",
                             max_passes));
    return std::move(failures_);
}

/// Passes after the first only repair rounding. If that needs more pairs than the first pass, and more than a
/// million, the passes would not converge.
PassBudget Trial::effort(int pass) const {
    if (!is_operation_) return {available_memory()};
    PassBudget effort{memory_left(), SIZE_MAX, SIZE_MAX};
    if (pass == 0) return effort;
    const PassBudget least;
    effort.pairs = std::max(least.pairs, first_pairs_);
    effort.crossings = std::max(least.crossings, 2 * first_pairs_);
    effort.too_many = spreading;
    return effort;
}

Work Trial::finish() {
    work_.mesh.drop(mark_name, Domain::face);
    forget_change(work_.changes, mark_name);
    return std::move(work_);
}

void Trial::fail(std::uint32_t mark, const std::string& why) {
    if ((mark & ~fresh) != 0) failures_.try_emplace((mark & ~fresh) - 1, why);
}

bool Trial::one_pass(const Solids& solids, const SelfIntersections& found, double tolerance,
                     const Operands* operands, const PassBudget& effort) {
    United united = unite(work_.mesh, solids, found, {tolerance, settings_.single}, operands, effort);
    short_of_memory_ |= united.short_of_memory;
    first_pairs_ = std::max(first_pairs_, united.pairs);
    for (const auto& refused :
         united.refused) { // refused has clusters of this pass; marks give the original cluster
        for (Index f = 0; f < work_.mesh.face_count(); ++f)
            if (solids.cluster_of_face(f) == refused.cluster) fail(marks_of(work_.mesh)[f], refused.why);
    }
    if (!united.refused.empty()) return false;
    is_tidy_ = is_tidy(united.mesh, united.settled, united.uncut_faces);
    edges_.reset();
    work_.mesh = std::move(united.mesh);
    work_.changes = std::move(united.changes);
    auto& marks = std::get<std::vector<std::uint32_t>>(work_.mesh.find(mark_name, Domain::face)->data);
    for (std::size_t f = 0; f < marks.size(); ++f)
        marks[f] = (marks[f] & ~fresh) | (f < united.uncut_faces ? 0 : fresh);
    work_.counts.refined_faces += united.cut_faces;
    work_.counts.covered_faces += united.covered_faces;
    return true;
}

void Trial::tidy() {
    const CleanCounts before = work_.counts;
    if (settings_.weld != Nearness::off) weld_equal(work_, settings_.non_manifold);
    if (settings_.degenerate) {
        take_out_flat(work_);
        remove_degenerate(work_);
    }
    if (settings_.duplicates) remove_duplicates(work_, settings_.walls);
    if (settings_.non_manifold)
        take_apart_non_manifold(work_, {.all = true, .single = settings_.single}, &edges_);
    work_.counts = before; // this is part of the union, so it is not counted
}

/// Faces that are not fresh intersect no more than before the last pass.
SelfIntersections Trial::crossings_of_fresh() const {
    const auto marks = marks_of(work_.mesh);
    std::vector<std::uint8_t> among(marks.size());
    for (std::size_t f = 0; f < among.size(); ++f) among[f] = (marks[f] & fresh) != 0;
    SelfIntersections found = crossings_near(work_.mesh, among);
    std::erase_if(found.pairs, [&](const auto& pair) { // removes pairs that existed before
        const auto m = marks[pair.first] & ~fresh, n = marks[pair.second] & ~fresh;
        return (m == 0 && solids_.meets_unfit[n - 1]) || (n == 0 && solids_.meets_unfit[m - 1]);
    });
    return found;
}

/// Fails clusters whose remaining intersections are not between closed, outward components of clusters.
void Trial::check_marks(const Solids& solids, const SelfIntersections& found) {
    const auto marks = marks_of(work_.mesh);
    for (const auto& [f, g] : found.pairs)
        for (const auto& [one, other] : {std::pair{f, g}, std::pair{g, f}})
            if ((marks[other] & ~fresh) == 0)
                fail(marks[one], "the union, rounded, would intersect another component");
            else if (!solids.closed[solids.components.of_face[one]])
                fail(marks[one], "the union, rounded, would not be closed");
}

Failures Trial::open_clusters(std::size_t& crowded) const {
    const Mesh& mesh = work_.mesh;
    Failures failures;
    crowded = 0;
    if (is_tidy_) return failures;
    const auto marks = marks_of(mesh);
    const EdgeTable built = edges_ ? EdgeTable{} : build_edges(mesh);
    const EdgeTable& edges = edges_ ? *edges_ : built;
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

} // namespace facetmill::clean_steps
