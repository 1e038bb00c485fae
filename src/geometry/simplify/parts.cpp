// Simplifies the parts of a scene as planned, each by its share of the target, and compares each with its
// input.

#include "base/progress.hpp"
#include "geometry/simplify/parts_plan.hpp"
#include "geometry/simplify/sharing.hpp"
#include "mesh/placement.hpp"
#include "mesh/surface.hpp"
#include "mesh/transform.hpp"

#include <map>

namespace facetmill {

namespace {

using namespace simplification;
using Stop = SimplifyResult::Stop;
using Intersections = SimplifySettings::Intersections;

/// The data of an input part that reports compare with the result.
struct Before {
    Surface surface;             ///< surface in the world
    SimplifiedPart::Size size;   ///< sizes in the world
    Properties properties;       ///< properties in the world, for methods that may change more than the size
    std::optional<double> limit; ///< max_quadric_error, in the part's own units
};

/// Measurements of a part; rigid motions do not change them.
struct Measured {
    SimplifiedPart::Sizes sizes;
    DeviationResult deviation;
};

struct PartsWork {
    Scene& scene;
    PartsPlan plan;
    std::vector<std::vector<SimplifyResult>> results{}; ///< [parts][levels] computed but not yet passed on
    std::map<std::size_t, std::vector<SimplifyResult>> repeats{}; ///< results that are needed again
    std::map<std::size_t, std::size_t> shares{};   ///< [first parts of sets] target number of triangles
    Stop shared_stop = Stop::nothing;              ///< the reason that ended the shared work
    std::vector<Before> before{};                  ///< [parts] data to compare with
    std::vector<std::vector<Measured>> measured{}; ///< [parts][levels] measurements
};

SimplifiedPart::Size size_of(const Mesh& mesh, const SurfaceSize& size) {
    return {size.area, mesh.face_count() > 0 ? size.volume : 0};
}

/// Stores the data that the results are compared with.
void note_before(PartsWork& w, const PartSet& set, std::optional<double> limit) {
    ProgressSteps steps(std::vector<double>(set.size(), 1));
    for (const std::size_t p : set) {
        const Part& part = w.scene.parts[p];
        Before& before = w.before[p];
        if (w.plan.measures() && w.plan.measured_as[p] == p) {
            before.surface = surface_of(part);
            before.size = size_of(part.mesh, w.plan.o.size_before(p));
        }
        if (w.plan.changes_topology()) before.properties = inspect(part);
        before.limit = limit;
        steps.next();
    }
}

void keep_for_repeats(PartsWork& w, std::size_t part) {
    if (w.plan.work.uses[part] > 1) w.repeats[part] = w.results[part];
}

/// The sets that share a target, without sets that repeat the work of another.
std::vector<PartSet> sharing_sets(const PartsPlan& plan) {
    std::vector<PartSet> sets;
    for (std::size_t p = 0; p < plan.work.first.size() && plan.o.by_error; ++p) {
        if (!plan.o.selected[p] || plan.work.first[p] != p) continue;
        if (PartSet set = plan.set_with(p); set.front() == p) sets.push_back(std::move(set));
    }
    return sets;
}

/// keep: the meshes also stay in the scene.
SharingMeshes sharing_meshes(PartsWork& w, const PartSet& set, SimplifySettings settings, bool keep) {
    SharingMeshes sharing;
    sharing.lock = std::move(settings.lock);
    sharing.max_quadric_error = settings.max_quadric_error;
    sharing.scale = ordering_scale(w.scene.parts[set.front()].transform);
    sharing.uses = w.plan.work.uses[set.front()];
    for (const std::size_t p : set) {
        Mesh& mesh = w.scene.parts[p].mesh;
        sharing.meshes.push_back(keep ? mesh : std::exchange(mesh, {}));
    }
    return sharing;
}

/// If several sets share a target: computes their results. If the method does more than collapse edges:
/// computes only the number of triangles for each set.
void share_target(PartsWork& w) {
    const std::vector<PartSet> sets = sharing_sets(w.plan);
    if (sets.size() < 2) return;
    SimplifySettings all = w.plan.o.all;
    all.max_quadric_error.reset(); // each set has its own limit
    const bool lods = !all.levels.empty();
    const bool more = !lods && (all.max_error || all.self_intersections != Intersections::ignore);
    if (lods) all.self_intersections = Intersections::ignore;
    std::vector<SharingMeshes> sharing;
    ProgressSteps steps({1, 9});
    {
        ProgressSteps of_sets(std::vector<double>(sets.size(), 1));
        for (const PartSet& set : sets) {
            SimplifySettings own = settings_for(set, w.plan);
            if (!more) note_before(w, set, own.max_quadric_error);
            sharing.push_back(sharing_meshes(w, set, std::move(own), more));
            of_sets.next();
        }
    }
    steps.next();
    if (more) {
        const SimplifyShares shares = simplify_shares(std::move(sharing), all);
        w.shared_stop = shares.stop;
        if (shares.stop != Stop::stuck) // otherwise each is simplified as far as possible
            for (std::size_t i = 0; i < sets.size(); ++i) w.shares[sets[i].front()] = shares.faces[i];
        return;
    }
    auto results = simplify_sharing(std::move(sharing), all);
    for (std::size_t i = 0; i < sets.size(); ++i) {
        for (auto& level : results[i])
            for (std::size_t k = 0; k < sets[i].size(); ++k)
                w.results[sets[i][k]].push_back(std::move(level[k]));
        keep_for_repeats(w, sets[i].front());
    }
}

/// Computes the results of the parts of a set, one per level.
void simplify_set(PartsWork& w, const PartSet& set) {
    ProgressSteps steps({1, 9});
    SimplifySettings settings = settings_for(set, w.plan);
    note_before(w, set, settings.max_quadric_error);
    steps.next();
    const std::size_t front = set.front();
    auto& results = w.results[front];
    if (const std::size_t as = w.plan.work.first[front]; as != front) {
        results = w.repeats.at(as);
        return;
    }
    const auto share = w.shares.find(front);
    if (share != w.shares.end()) {
        settings.ratio.reset();
        settings.vertices.reset();
        settings.faces = share->second;
    }
    if (set.size() > 1) {
        std::vector<const Mesh*> meshes;
        for (const std::size_t p : set) meshes.push_back(&w.scene.parts[p].mesh);
        for (auto& level : simplify_jointly(meshes, settings))
            for (std::size_t i = 0; i < set.size(); ++i) w.results[set[i]].push_back(std::move(level[i]));
    } else if (!settings.levels.empty()) {
        results = simplify_levels(std::move(w.scene.parts[front].mesh), settings);
    } else {
        results.push_back(simplify(std::move(w.scene.parts[front].mesh), settings));
    }
    for (std::size_t i = 0; share != w.shares.end() && i < set.size(); ++i) {
        Stop& stop = w.results[set[i]].front().stop; // a part that reached its share met the common target
        if (stop == Stop::faces || stop == Stop::nothing) stop = w.shared_stop;
    }
    keep_for_repeats(w, front);
}

/// Measures a level of a part. A part that differs from an earlier one only by a rigid motion shares its
/// measurements.
void measure(PartsWork& w, const Part& part, std::size_t number, std::size_t level, SimplifiedPart& entry) {
    const std::size_t as = w.plan.measured_as[number];
    if (as == number) {
        const Before& before = w.before[number];
        entry.surface = surface_size(part.mesh, part.transform);
        w.measured[number].push_back(
            {{before.size, size_of(part.mesh, *entry.surface)},
             deviation(before.surface, surface_of(part),
                       {.samples = w.plan.samples[number], .certify = w.plan.o.certify})});
    }
    const Measured& m = w.measured[as][level];
    entry.sizes = m.sizes;
    entry.deviation = m.deviation;
    if (as == number) return;
    const Vec3 by = in_world(part, {}) - in_world(w.scene.parts[as], {});
    for (DirectedDeviation* d : {&entry.deviation->forward, &entry.deviation->backward}) {
        d->from += by;
        d->to += by;
    }
}

/// Compares a level of a part. The part holds the mesh of the level during the comparison.
SimplifiedPart settled_level(PartsWork& w, std::size_t number, std::size_t level) {
    Part& part = w.scene.parts[number];
    SimplifiedPart entry;
    entry.result = std::move(w.results[number][level]);
    entry.scale = greatest_stretch(part.transform);
    if (const auto limit = w.before[number].limit) entry.max_quadric_error = *limit * entry.scale;
    for (const std::size_t p : w.plan.set_with(number)) {
        if (p == number) continue;
        if (!entry.joint_with) entry.joint_with.emplace();
        entry.joint_with->push_back(w.scene.parts[p].name);
    }
    part.mesh = std::move(entry.result.mesh);
    ProgressSteps steps({w.plan.changes_topology() ? 1.0 : 0.0, 9});
    if (w.plan.changes_topology()) entry.topology = {w.before[number].properties, inspect(part)};
    steps.next();
    if (w.plan.measures()) measure(w, part, number, level, entry);
    entry.result.mesh = std::move(part.mesh);
    return entry;
}

std::vector<SimplifiedPart> settled(PartsWork& w, std::size_t number) {
    std::vector<SimplifiedPart> levels;
    levels.reserve(w.results[number].size());
    ProgressSteps steps(std::vector<double>(w.results[number].size(), 1));
    for (std::size_t level = 0; level < w.results[number].size(); ++level, steps.next())
        levels.push_back(settled_level(w, number, level));
    w.results[number] = {};
    w.before[number] = {};
    return levels;
}

} // namespace

void simplify_parts(Scene& scene, const SimplifyPartsSettings& settings,
                    const std::function<void(std::size_t, std::vector<SimplifiedPart>)>& take) {
    const std::size_t count = scene.parts.size();
    PartsWork w{scene, plan_parts(scene, settings)};
    w.results.resize(count);
    w.before.resize(count);
    w.measured.resize(count);
    std::vector<double> lengths;
    for (std::size_t p = 0; p < count; ++p)
        if (settings.selected[p]) lengths.push_back(1 + double(scene.parts[p].mesh.face_count()));
    const bool shared = settings.by_error && count > 1;
    const double measuring = !w.plan.measures() ? 0.2
                             : settings.certify ? 5
                                                : 2; // time of measuring relative to the collapses
    ProgressSteps steps({shared ? 1.0 : 0.0, (shared ? 0.0 : 1.0) + measuring});
    share_target(w);
    steps.next();
    ProgressSteps of_parts(std::move(lengths));
    const auto finish = [&](std::size_t p) {
        const bool has_results = !w.results[p].empty();
        ProgressSteps of_part({has_results ? 0.0 : 1.0, measuring});
        if (!has_results) simplify_set(w, w.plan.set_with(p));
        of_part.next();
        scene.parts[p].mesh = {};
        take(p, settled(w, p));
        if (--w.plan.work.uses[w.plan.work.first[p]] == 0) w.repeats.erase(w.plan.work.first[p]);
    };
    for (std::size_t p = 0; p < count; ++p) {
        if (!settings.selected[p]) continue;
        finish(p);
        of_parts.next();
    }
}

} // namespace facetmill
