#include "geometry/clean/clean.hpp"

#include "base/math/numbers.hpp"
#include "base/progress.hpp"
#include "geometry/boolean/solids.hpp"
#include "geometry/clean/steps.hpp"
#include "geometry/edit/t_junctions.hpp"
#include "mesh/face.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::clean_steps {

bool resolve_t_junctions(Work& work, double tolerance) {
    auto insertions = find_t_junctions(work.mesh, tolerance);
    if (insertions.empty()) return false;
    work.counts.t_junctions += insertions.size();
    work.mesh = insert_on_edges(work.mesh, std::move(insertions), {}, &work.changes);
    return true;
}

} // namespace facetmill::clean_steps

namespace facetmill {

namespace {

using namespace clean_steps;

void tell_of_crossings(Work& work, std::string why, const Vec3& at) {
    work.not_done.push_back({"self_intersections", std::move(why), at});
}

/// The intersections of the mesh. If too many boxes meet, does not search and reports this.
SelfIntersections affordable_crossings(Work& work) {
    const std::size_t free = work.max_box_pairs() - work.budget.box_pairs;
    SelfIntersections found = crossings(work.mesh, {}, work.max_box_pairs());
    const std::size_t beyond = found.box_pairs - std::min(free, found.box_pairs);
    work.budget.box_pairs -= std::min(found.too_many ? beyond / 16 : beyond, work.budget.box_pairs);
    if (found.too_many)
        tell_of_crossings(
            work,
            fmt::format("not searched for, because the bounding boxes of more than {} pairs of its {} faces "
                        "meet; cut the part into smaller parts first, or make walls and tubes thinner",
                        found.box_pairs - 1, work.mesh.face_count()),
            corner_mean(work.mesh, 0));
    return found;
}

bool untangle_once(Work& work, const CleanSettings& s) {
    SelfIntersections found = affordable_crossings(work);
    if (found.too_many) return false;
    const bool unites = s.self_intersections != Untangle::local;
    const auto overlaps = unites ? overlaps_at_edges(work.mesh) : std::vector<std::pair<Index, Index>>{};
    work.untangled = found.count == 0 && overlaps.empty();
    if (work.untangled) return false;
    if (found.count > found.pairs.size()) {
        tell_of_crossings(
            work,
            fmt::format("{} pairs of faces intersect, but at most {} are processed", found.count, max_pairs),
            corner_mean(work.mesh, found.pairs[0].first));
        return false;
    }
    if (!work.may_process(found.count)) {
        tell_of_crossings(
            work,
            fmt::format("{} pairs of its {} faces intersect, but at most {} can be tried in reasonable time; "
                        "cut the part into smaller parts first, or make walls and tubes thinner",
                        found.count, work.mesh.face_count(), work.budget.vain_pairs),
            corner_mean(work.mesh, found.pairs[0].first));
        return false;
    }
    bool changed = unites && unite_solids(work, found, overlaps, s);
    if (s.self_intersections == Untangle::unite || work.untangled) return changed;
    if (changed) found = affordable_crossings(work);
    return resolve_self_intersections(work, std::move(found)) || changed;
}

bool untangle(Work& work, const CleanSettings& s) {
    if (s.self_intersections == Untangle::off || work.untangled) return false;
    const std::size_t told = work.not_done.size();
    if (work.tangled) {
        work.not_done.insert(work.not_done.end(), work.tangled->begin(), work.tangled->end());
        return false;
    }
    const bool changed = untangle_once(work, s);
    if (!changed && !work.untangled)
        work.tangled.emplace(work.not_done.begin() + static_cast<std::ptrdiff_t>(told), work.not_done.end());
    return changed;
}

bool one_round(Work& work, const CleanSettings& s) {
    work.not_done.clear();
    bool changed = false;
    const auto did = [&](bool any) {
        changed |= any;
        if (!any) return;
        work.untangled = false;
        work.tangled.reset();
    };
    // The next round unites a patch with the faces that it intersects, or reports it.
    const bool may_cross = s.self_intersections == Untangle::unite || s.self_intersections == Untangle::all;
    ProgressSteps steps({2, 2, 2, s.self_intersections != Untangle::off ? 20.0 : 0.0, 1});
    if (s.single) did(round_to_single(work));
    if (s.weld != Nearness::off) did(weld_equal(work, s.non_manifold));
    if (s.weld == Nearness::near) did(weld_near(work, s.tolerance));
    if (s.degenerate) did(remove_degenerate(work));
    if (s.duplicates) did(remove_duplicates(work, s.walls));
    steps.next();
    if (s.t_junctions != Nearness::off)
        did(resolve_t_junctions(work, s.t_junctions == Nearness::near ? s.tolerance : 0));
    if (s.stitch != Nearness::off) did(stitch(work, s.stitch == Nearness::near ? s.tolerance : 0));
    steps.next();
    if (s.holes && s.non_manifold) { // splitting vertices afterwards would merge holes that touch at a vertex
        const std::size_t told = work.not_done.size();
        did(fill_holes(work, *s.holes, nullptr, may_cross));
        work.not_done.resize(told); // holes that stay are reported below
    }
    if (s.non_manifold) did(take_apart_non_manifold(work, {.single = s.single}));
    steps.next();
    changed |= untangle(work, s);
    steps.next();
    if (s.holes) did(fill_holes(work, *s.holes, nullptr, may_cross));
    if (s.open_components) did(remove_open_components(work));
    if (s.components) did(remove_components(work, *s.components));
    if (s.inner_components) did(remove_inner_components(work));
    if (s.isolated && !work.cloud) did(remove_isolated(work));
    // This step is last, so that no other step processes surfaces that are only a few rounding steps apart.
    if (s.apart && s.single && s.non_manifold && s.weld != Nearness::off && !changed) did(move_apart(work));
    return changed;
}

/// The changes to the attributes; dropping faces and vertices does not change the remaining values.
AttributeChanges changes_of(const Mesh& mesh, const AttributeChanges& mixed) {
    return mixed.empty() ? kept_changes(mesh.attributes) : mixed;
}

/// Runs rounds until one changes nothing. Returns their number.
int run_rounds(Work& work, const CleanSettings& settings) {
    constexpr int max_rounds = 32;
    int count = 0;
    ProgressRounds rounds;
    for (bool changed = true; changed && count < max_rounds; ++count, rounds.next())
        changed = one_round(work, settings);
    return count;
}

bool rounding_moves(const Mesh& mesh) {
    return std::any_of(mesh.positions.begin(), mesh.positions.end(),
                       [](const Vec3& p) { return is_finite(p) && as_float32(p) != p; });
}

/// Whether faces intersect now that did not before. If some intersected before, all stay, because old and new
/// intersections cannot be distinguished; the new ones are reported.
bool is_tangled_by_rounding(Work& work, const Mesh& before) {
    const SelfIntersections now = affordable_crossings(work);
    if (now.too_many || now.count == 0) return false;
    const SelfIntersections then = crossings(before, {}, work.max_box_pairs());
    if (!then.too_many && then.count == 0) return true;
    if (then.too_many || now.count > then.count)
        work.not_done.push_back(
            {"precision",
             fmt::format("{} pairs of faces intersect after rounding to 32-bit floats, {} "
                         "before; self_intersections: all resolves them",
                         now.count, then.too_many ? "an unknown number" : fmt::format("{}", then.count)),
             corner_mean(work.mesh, now.pairs[0].first)});
    return false;
}

} // namespace

std::size_t CleanCounts::total() const {
    return rounded_vertices + welded_vertices + stitched_edges + t_junctions + repeated_corners +
           degenerate_faces + duplicate_faces + split_vertices + split_edges + filled_holes +
           open_components + components + inner_components + isolated_vertices + intersecting_faces +
           united_components + moved_apart;
}

CleanResult clean(Mesh mesh, const CleanSettings& settings) {
    Work work;
    std::optional<Mesh> exact; // the mesh before rounding, to find intersections that rounding causes
    if (settings.single && settings.self_intersections == Untangle::off && rounding_moves(mesh)) exact = mesh;
    work.mesh = std::move(mesh);
    work.budget = settings.budget;
    work.cloud = work.mesh.face_count() == 0;
    CleanResult result;
    result.rounds = run_rounds(work, settings);
    if (exact && is_tangled_by_rounding(work, *exact)) {
        CleanSettings untangling = settings;
        untangling.self_intersections = Untangle::all;
        result.rounds += run_rounds(work, untangling);
    }
    result.changes = changes_of(work.mesh, work.changes);
    result.mesh = std::move(work.mesh);
    result.counts = work.counts;
    result.budget = work.budget;
    result.short_of_memory = work.short_of_memory;
    result.not_done = std::move(work.not_done);
    return result;
}

} // namespace facetmill
