#include "stages/simplify/parts.hpp"

#include "base/progress.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "geometry/deviation/deviation.hpp"
#include "geometry/edit/moved.hpp"
#include "mesh/equal_meshes.hpp"
#include "mesh/placement.hpp"
#include "mesh/power_scale.hpp"
#include "mesh/surface.hpp"
#include "mesh/transform.hpp"
#include "stages/simplify/report.hpp"

#include <array>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <span>

namespace facetmill::simplify_stage {

namespace {

using Stop = SimplifyResult::Stop;
using Set = std::vector<std::size_t>; ///< parts, by their number in the scene

std::size_t triangle_count(const Mesh& mesh) { return mesh.corner_count() - 2 * mesh.face_count(); }

/// A share of a count that is meant for all, rounded down; it may be none.
std::optional<std::size_t> share(std::optional<std::int64_t> whole, std::size_t own, std::size_t all) {
    if (!whole) return {};
    if (own == all || all == 0) return static_cast<std::size_t>(*whole);
    return static_cast<std::size_t>(static_cast<double>(*whole) *
                                    (static_cast<double>(own) / static_cast<double>(all)));
}

/// How far a scale may be off where it only orders the errors of parts: nodes that differ by a rotation have
/// the same.
double rounded_scale(double scale) {
    int exponent = 0;
    const double mantissa = std::frexp(scale, &exponent);
    return std::ldexp(std::round(std::ldexp(mantissa, 20)), exponent - 20);
}

/// What a part's share of the samples depends on.
struct SampledSize {
    double area = 0;
    std::size_t triangles = 0;
};

SampledSize sampled_size(const Surface& surface) {
    SampledSize size{0, surface.size()};
    for (std::size_t t = 0; t < surface.size(); ++t) {
        const Vec3& a = surface.point(t, 0);
        const double area = length(cross(surface.point(t, 1) - a, surface.point(t, 2) - a)) / 2;
        if (std::isfinite(area)) size.area += area;
    }
    return size;
}

/// Samples of parts that are measured one by one, so that all together have `all`: half of them go by area,
/// half by the number of triangles (all of them where there is no finite area), rounded up. A single part has
/// all.
std::vector<std::size_t> shared_samples(std::size_t all, std::span<const SampledSize> parts) {
    double area = 0;
    double triangles = 0;
    for (const auto& part : parts) {
        area += part.area;
        triangles += static_cast<double>(part.triangles);
    }
    const bool by_area = area > 0 && std::isfinite(area);
    std::vector<std::size_t> shares;
    for (const auto& part : parts) {
        double share = triangles > 0 ? static_cast<double>(part.triangles) / triangles : 0;
        if (by_area) share = share / 2 + part.area / area / 2;
        shares.push_back(static_cast<std::size_t>(std::ceil(share * static_cast<double>(all))));
    }
    return shares;
}

/// A part as it came, as far as the report compares with it.
struct Before {
    Surface surface;       ///< in the world
    Size size;             ///< in the world
    Properties properties; ///< in the world, where the method may change more than that
};

/// What was measured of a part, which holds wherever it is moved to.
struct Measured {
    SimplifiedPart::Sizes sizes;
    DeviationResult deviation;
};

Size size_of(const Part& part, const SurfaceSize& size) {
    return {size.area, part.mesh.face_count() > 0 ? size.volume : 0};
}

Measured carried(Measured m, const Vec3& by) {
    for (DirectedDeviation* d : {&m.deviation.forward, &m.deviation.backward}) {
        d->from += by;
        d->to += by;
    }
    return m;
}

class Simplifier {
  public:
    Simplifier(Scene scene, const SimplifyOptions& o, Context& context, SimplifyReport& report)
        : scene_(std::move(scene)), o_(o), context_(context), report_(report) {
        for (const auto& part : scene_.parts) {
            if (!context.selects(part, scene_)) continue;
            faces_ += triangle_count(part.mesh);
            vertices_ += part.mesh.vertex_count();
        }
        if (o.constraints.hausdorff)
            hausdorff_ = context.resolve(*o.constraints.hausdorff, scene_, "constraints.hausdorff");
        if (o.max_error) max_error_ = context.resolve(*o.max_error, scene_, "max_error");
        const bool limited = o.max_quadric_error && has_quadrics(o) && !max_error_;
        if (limited && !is_of_part(*o.max_quadric_error))
            max_quadric_error_ = context.resolve(*o.max_quadric_error, scene_, "max_quadric_error");
        else if (limited)
            max_of_diagonal_ = o.max_quadric_error->amount / 100;
    }

    Scene run() {
        find_sets();
        share_samples();
        find_repeats();
        results_.resize(scene_.parts.size());
        before_.resize(scene_.parts.size());
        measured_.resize(scene_.parts.size());
        limits_.resize(scene_.parts.size());
        // An entry is a kilobyte: to grow the list would copy and fault in several times as many.
        report_.parts.reserve(scene_.parts.size() * (o_.lods ? o_.lods->ratios.size() : 1));
        const bool shared = shares_by_error(o_) && scene_.parts.size() > 1;
        const double measuring = !measures() ? 0.2 : o_.certify ? 5 : 2; // beside what is collapsed
        ProgressSteps steps({shared ? 1.0 : 0.0, (shared ? 0.0 : 1.0) + measuring});
        share_target();
        steps.next();
        std::vector<Part> levels;
        context_.for_each_part(scene_, [&](Part& part) {
            const auto number = static_cast<std::size_t>(&part - scene_.parts.data());
            const bool has_results = !results_[number].empty();
            ProgressSteps of_part({has_results ? 0.0 : 1.0, measuring});
            if (!has_results) simplify_set(set_of(number));
            of_part.next();
            settle(part, number, levels);
            if (--uses_[work_as_[number]] == 0) repeated_.erase(work_as_[number]);
        });
        for (Part& level : levels) scene_.parts.push_back(std::move(level));
        if (o_.max_quadric_error) warn_of_limit(limited_, *o_.max_quadric_error, context_);
        return std::move(scene_);
    }

  private:
    static bool is_of_part(const Length& length) {
        return length.kind == Length::Kind::percent && length.of == Length::Of::part;
    }
    bool measures() const { return o_.measure || o_.certify; }
    bool changes_topology() const {
        return o_.settings.topology == SimplifySettings::Topology::allow ||
               o_.settings.method == SimplifySettings::Method::cluster;
    }

    /// Which parts are simplified as one, and which vertices of others stay because another part has them
    /// too.
    void find_sets() {
        const bool matches_anyway =
            o_.lock.boundary || o_.settings.method == SimplifySettings::Method::constrained;
        if (scene_.parts.size() < 2 || matches_anyway ||
            o_.settings.method == SimplifySettings::Method::cluster)
            return;
        std::vector<PlacedMesh> placed;
        for (const Part& part : scene_.parts) placed.push_back({&part.mesh, part.transform});
        contacts_ = find_contacts(placed);
        set_of_.assign(scene_.parts.size(), nullptr);
        for (const Set& set : contacts_.sets)
            if (fits(set))
                for (const std::size_t p : set) set_of_[p] = &set;
    }

    /// Shares the samples out among the parts that are simplified.
    void share_samples() {
        samples_.assign(scene_.parts.size(), 0);
        if (!measures() && !max_error_) return;
        std::vector<std::size_t> selected;
        for (std::size_t p = 0; p < scene_.parts.size(); ++p)
            if (context_.selects(scene_.parts[p], scene_)) selected.push_back(p);
        std::vector<SampledSize> sizes(selected.size(), {0, 1});
        for (std::size_t i = 0; selected.size() > 1 && i < selected.size(); ++i)
            sizes[i] = sampled_size(surface_of(scene_.parts[selected[i]]));
        const auto shares = shared_samples(DeviationSettings{}.samples, sizes);
        for (std::size_t i = 0; i < selected.size(); ++i) samples_[selected[i]] = shares[i];
    }

    bool fits(const Set& set) const {
        std::vector<const Mesh*> meshes;
        for (const std::size_t p : set) {
            const Part& part = scene_.parts[p];
            if (!context_.selects(part, scene_)) return false;
            if (part.transform != scene_.parts[set.front()].transform) return false;
            meshes.push_back(&part.mesh);
        }
        return can_simplify_jointly(meshes, simplify_settings(o_, {}, {}));
    }

    Set set_of(std::size_t part) const {
        return set_of_.empty() || !set_of_[part] ? Set{part} : *set_of_[part];
    }

    /// Finds the parts that have the mesh of an earlier one, so that their result is that one's; and so is
    /// what is measured, when they are the same but for a move.
    void find_repeats() {
        work_as_.resize(scene_.parts.size());
        std::iota(work_as_.begin(), work_as_.end(), std::size_t{0});
        measured_as_ = work_as_;
        uses_.assign(work_as_.size(), 1);
        if (work_as_.size() < 2 || o_.lock.box) return; // the box meets each elsewhere
        const std::vector<std::size_t> equal = first_with_equal_mesh(scene_);
        std::map<std::pair<std::size_t, std::uint64_t>, std::size_t> worked;
        std::map<std::pair<std::size_t, std::array<std::uint64_t, 9>>, std::size_t> measured;
        for (std::size_t p = 0; p < equal.size(); ++p) {
            const bool touches = !contacts_.shared.empty() && !contacts_.shared[p].empty();
            if (touches || !context_.selects(scene_.parts[p], scene_)) continue;
            const Transform to_world = scene_.parts[p].transform;
            double scale = 1;
            if (max_error_ || hausdorff_ || max_quadric_error_)
                scale = greatest_stretch(to_world);
            else if (shares_by_error(o_))
                scale = rounded_scale(greatest_stretch(to_world));
            work_as_[p] = worked.try_emplace({equal[p], key_of(scale)}, p).first->second;
            if (work_as_[p] != p) ++uses_[work_as_[p]];
            measured_as_[p] = measured.try_emplace({work_as_[p], axes_in_world(to_world)}, p).first->second;
        }
    }

    SimplifyShare share_of(const Set& set, double scale) const {
        std::size_t faces = 0, vertices = 0;
        for (const std::size_t p : set) {
            faces += triangle_count(scene_.parts[p].mesh);
            vertices += scene_.parts[p].mesh.vertex_count();
        }
        SimplifyShare mine{share(o_.faces, faces, faces_), share(o_.vertices, vertices, vertices_),
                           max_error_, max_quadric_error_, hausdorff_};
        for (auto* length : {&mine.max_error, &mine.max_quadric_error, &mine.hausdorff})
            if (*length) **length /= scale;
        if (max_of_diagonal_) {
            Box box;
            for (const std::size_t p : set) box.add(scene_.parts[p].mesh.bounds());
            mine.max_quadric_error = *max_of_diagonal_ * diagonal(box);
        }
        if (!(mine.max_quadric_error > 0.0)) mine.max_quadric_error.reset(); // of a single point
        return mine;
    }

    SimplifySettings settings_for(const Set& set) const {
        const Transform to_world = scene_.parts[set.front()].transform;
        SimplifySettings s = simplify_settings(o_, to_world, share_of(set, greatest_stretch(to_world)));
        s.samples = 0;
        for (const std::size_t p : set) s.samples += samples_[p];
        if (set.size() == 1 && !contacts_.shared.empty()) s.lock.vertices = contacts_.shared[set.front()];
        return s;
    }

    // A target that several parts share by error.

    /// The sets whose work is not another's; those that one target is shared by.
    std::vector<Set> sharing_sets() const {
        std::vector<Set> sets;
        for (std::size_t p = 0; p < scene_.parts.size() && shares_by_error(o_); ++p) {
            if (!context_.selects(scene_.parts[p], scene_) || work_as_[p] != p) continue;
            if (Set set = set_of(p); set.front() == p) sets.push_back(std::move(set));
        }
        return sets;
    }

    /// Where several sets share a target: sets their results; or, where each has more to do than to collapse
    /// edges, how many triangles it is to have.
    void share_target() {
        const std::vector<Set> sets = sharing_sets();
        if (sets.size() < 2) return;
        SimplifySettings all = settings_for(sets.front());
        all.faces = o_.faces;
        all.vertices = o_.vertices;
        const bool more =
            !o_.lods && (max_error_ || all.self_intersections != SimplifySettings::Intersections::ignore);
        if (o_.lods) all.self_intersections = SimplifySettings::Intersections::ignore;
        std::vector<SharingMeshes> sharing;
        ProgressSteps steps({1, 9});
        {
            ProgressSteps of_sets(std::vector<double>(sets.size(), 1));
            for (const Set& set : sets) {
                if (!more) note_before(set);
                sharing.push_back(sharing_meshes(set, more));
                of_sets.next();
            }
        }
        steps.next();
        if (more) {
            const SimplifyShares shares = simplify_shares(std::move(sharing), all);
            shared_stop_ = shares.stop;
            if (shares.stop != Stop::stuck) // else each goes as far as it can
                for (std::size_t i = 0; i < sets.size(); ++i) shares_[sets[i].front()] = shares.faces[i];
            return;
        }
        auto results = simplify_sharing(std::move(sharing), all);
        for (std::size_t i = 0; i < sets.size(); ++i) {
            for (auto& level : results[i])
                for (std::size_t k = 0; k < sets[i].size(); ++k)
                    results_[sets[i][k]].push_back(std::move(level[k]));
            keep_for_repeats(sets[i].front());
        }
    }

    /// keep: the meshes stay in the scene, too.
    SharingMeshes sharing_meshes(const Set& set, bool keep) {
        SimplifySettings settings = settings_for(set);
        SharingMeshes sharing;
        sharing.lock = std::move(settings.lock);
        sharing.max_quadric_error = settings.max_quadric_error;
        sharing.scale = rounded_scale(greatest_stretch(scene_.parts[set.front()].transform));
        sharing.uses = uses_[set.front()];
        for (const std::size_t p : set) {
            Mesh& mesh = scene_.parts[p].mesh;
            if (keep) {
                sharing.meshes.push_back(mesh);
                continue;
            }
            Mesh left; // `only` may name a material
            left.primitives = mesh.primitives;
            sharing.meshes.push_back(std::exchange(mesh, std::move(left)));
        }
        return sharing;
    }

    /// Notes what is compared with the results.
    void note_before(const Set& set) {
        ProgressSteps steps(std::vector<double>(set.size(), 1));
        for (const std::size_t p : set) {
            const bool is_first = measures() && measured_as_[p] == p;
            if (is_first) {
                before_[p].surface = surface_of(scene_.parts[p]);
                before_[p].size = size_of(scene_.parts[p], context_.size_before(scene_, p));
            }
            if (changes_topology()) before_[p].properties = inspect(scene_.parts[p]);
            limits_[p] = settings_for(set).max_quadric_error;
            steps.next();
        }
    }

    void keep_for_repeats(std::size_t part) {
        if (uses_[part] > 1) repeated_[part] = results_[part];
    }

    /// Sets the results of the parts of a set, one for each level.
    void simplify_set(const Set& set) {
        ProgressSteps steps({1, 9});
        note_before(set);
        steps.next();
        if (const std::size_t as = work_as_[set.front()]; as != set.front()) {
            results_[set.front()] = repeated_.at(as);
            return;
        }
        SimplifySettings settings = settings_for(set);
        const auto share = shares_.find(set.front());
        if (share != shares_.end()) {
            settings.ratio.reset();
            settings.vertices.reset();
            settings.faces = share->second;
        }
        if (set.size() > 1) {
            std::vector<const Mesh*> meshes;
            for (const std::size_t p : set) meshes.push_back(&scene_.parts[p].mesh);
            for (auto& level : simplify_jointly(meshes, settings))
                for (std::size_t i = 0; i < set.size(); ++i) results_[set[i]].push_back(std::move(level[i]));
        } else if (o_.lods) {
            results_[set.front()] = simplify_levels(std::move(scene_.parts[set.front()].mesh), settings);
        } else {
            results_[set.front()].push_back(simplify(std::move(scene_.parts[set.front()].mesh), settings));
        }
        if (share != shares_.end())
            for (const std::size_t p : set) say_shared(results_[p].front());
        keep_for_repeats(set.front());
    }

    /// A part that has its share met the target of all, if that was met.
    void say_shared(SimplifyResult& r) const {
        if (r.stop == Stop::faces || r.stop == Stop::nothing) r.stop = shared_stop_;
    }

    /// Gives a part its result; coarser levels become parts of their own.
    void settle(Part& part, std::size_t number, std::vector<Part>& levels) {
        part.mesh = {};
        const Part base = part;
        ProgressSteps steps(std::vector<double>(results_[number].size(), 1));
        for (std::size_t i = 0; i < results_[number].size(); ++i) {
            Part level = base;
            if (i > 0) level.name += fmt::format(".lod{}", i);
            take(level, number, i, std::move(results_[number][i]));
            steps.next();
            if (i == 0) {
                part = std::move(level);
                continue;
            }
            level.changed = true;
            levels.push_back(std::move(level));
        }
        before_[number] = {};
    }

    /// Whether the target of a level is other than all that there is: 100 %, or as many faces, does nothing,
    /// as it says.
    bool asks_for_less(std::size_t level) const {
        if (o_.lods) return o_.lods->ratios[level].value < 1;
        const auto differs = [](std::optional<std::int64_t> target, std::size_t all) {
            return target && *target != static_cast<std::int64_t>(all);
        };
        if (o_.ratio && o_.ratio->value == 1 && !o_.faces && !o_.vertices) return false;
        if (!o_.ratio && (o_.faces || o_.vertices))
            return differs(o_.faces, faces_) || differs(o_.vertices, vertices_);
        return true;
    }

    void take(Part& part, std::size_t number, std::size_t number_of_level, SimplifyResult r) {
        part.mesh = std::move(r.mesh);
        context_.attribute_changes(part, r.changes);
        warn_of_stop(part, r,
                     {asks_for_less(number_of_level), o_.lods || o_.ratio || o_.faces || o_.vertices},
                     context_);
        if (r.stop == Stop::max_quadric_error) limited_.push_back({part.name, r.faces_before, r.faces_after});
        const double scale = greatest_stretch(part.transform);
        SimplifiedPart entry;
        entry.result = std::move(r);
        entry.scale = scale;
        entry.part = part.name;
        if (const auto limit = limits_[number]) entry.max_quadric_error = *limit * scale;
        if (const Set set = set_of(number); set.size() > 1)
            for (const std::size_t p : set) {
                if (p == number) continue;
                if (!entry.joint_with) entry.joint_with.emplace();
                entry.joint_with->push_back(scene_.parts[p].name);
            }
        ProgressSteps steps({changes_topology() ? 1.0 : 0.0, 9});
        if (changes_topology()) entry.topology = {before_[number].properties, inspect(part)};
        steps.next();
        if (measures()) {
            const Measured m = measure(part, number, number_of_level);
            entry.sizes = m.sizes;
            entry.deviation = m.deviation;
        }
        report_.parts.push_back(std::move(entry));
    }

    Measured measure(const Part& part, std::size_t number, std::size_t number_of_level) {
        const std::size_t as = measured_as_[number];
        if (as != number) {
            const Vec3 by = in_world(part, {}) - in_world(scene_.parts[as], {});
            return carried(measured_[as][number_of_level], by);
        }
        const Before& before = before_[number];
        const SurfaceSize size = surface_size(part.mesh, part.transform);
        if (!o_.lods) context_.keep_size(number, size); // else other parts come between
        Measured m{{before.size, size_of(part, size)},
                   deviation(before.surface, surface_of(part),
                             {.samples = samples_[number], .certify = o_.certify})};
        measured_[number].push_back(m);
        return m;
    }

    Scene scene_;
    const SimplifyOptions& o_;
    Context& context_;
    SimplifyReport& report_;
    std::size_t faces_ = 0, vertices_ = 0; ///< of all parts selected
    std::optional<double> max_error_, max_quadric_error_, hausdorff_;
    std::optional<double> max_of_diagonal_;     ///< max_quadric_error as a share of each part's diagonal
    std::vector<std::optional<double>> limits_; ///< [parts] max_quadric_error, in the part's own units
    std::map<std::size_t, std::size_t> shares_; ///< [first parts of sets] triangles that each is to have
    Stop shared_stop_ = Stop::nothing;          ///< what ended the work that gave the shares
    std::vector<Limited> limited_;
    Contacts contacts_;
    std::vector<const Set*> set_of_;                   ///< [parts] of contacts_, when simplified as one
    std::vector<std::vector<SimplifyResult>> results_; ///< [parts][levels] those found and not yet taken
    std::vector<Before> before_;                       ///< [parts]
    /// [parts] The first with the same mesh, itself for most: whose result it has, whose measurements.
    std::vector<std::size_t> work_as_, measured_as_;
    std::vector<std::size_t> uses_; ///< [parts] parts that still need its result
    std::map<std::size_t, std::vector<SimplifyResult>> repeated_; ///< results that are needed again
    std::vector<std::vector<Measured>> measured_;                 ///< [parts][levels]
    std::vector<std::size_t> samples_;                            ///< [parts] each way, of those selected
};

} // namespace

void warn_of_stop(const Part& part, const SimplifyResult& r, AskedFor asked, Context& context) {
    if (r.faces_before == 0 && asked.less)
        context.warn("W-SIMPLIFY-NOTHING",
                     fmt::format("part '{}' has no faces, which are what simplify makes fewer: {} as it is",
                                 part.name,
                                 part.mesh.vertex_count() > 0 ? "the cloud of points stays" : "it stays"),
                     "leave it out with only; crop, clip and tile work on points");
    else if (r.stop == Stop::nothing && asked.less)
        context.warn("W-SIMPLIFY-NOTHING",
                     fmt::format("part '{}' has {} and {}, at or below the target: nothing to do", part.name,
                                 counted(r.faces_before, "triangle"),
                                 counted(r.vertices_before, "vertex", "vertices")));
    if (r.stop == Stop::stuck && asked.target) // else it went as far as it goes within the error
        context.warn("W-SIMPLIFY-STOPPED",
                     fmt::format("part '{}' stopped at {}, above the target: {}", part.name,
                                 counted(r.faces_after, "triangle"), held_by(r)),
                     hint_for(r));
    if (r.faces_before > 0 && r.faces_after == 0)
        context.warn("W-SIMPLIFY-VANISHED", fmt::format("part '{}' has no faces left", part.name),
                     "ask for more faces, or keep the topology (topology: keep, and no cluster)");
}

void warn_of_limit(const std::vector<Limited>& limited, const Length& limit, Context& context) {
    if (limited.empty()) return;
    std::size_t before = 0, after = 0;
    for (const Limited& l : limited) {
        before += l.before;
        after += l.after;
    }
    const std::string first = fmt::format("part '{}'", limited.front().part);
    const std::string who = limited.size() == 1
                                ? first + " stopped at"
                                : fmt::format("{} parts, the first {}, stopped at", limited.size(), first);
    context.warn(
        "W-SIMPLIFY-LIMIT",
        fmt::format("{} {} of {} triangles, above the target: any fewer would move the surface by more "
                    "than max_quadric_error ({})",
                    who, grouped(after), grouped(before), limit.text),
        "a larger max_quadric_error, such as 5% of part, allows fewer triangles; max_quadric_error: off "
        "simplifies to the target regardless of the error");
}

Scene simplify_parts(Scene scene, const SimplifyOptions& o, Context& context, SimplifyReport& report) {
    return Simplifier(std::move(scene), o, context, report).run();
}

} // namespace facetmill::simplify_stage
