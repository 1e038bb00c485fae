#include "geometry/simplify/parts_plan.hpp"

#include "mesh/drawn_box.hpp"
#include "mesh/power_scale.hpp"
#include "mesh/surface.hpp"
#include "mesh/transform.hpp"

namespace facetmill {

namespace {

void add_counts(MeshCounts& counts, const Mesh& mesh) {
    counts.triangles += mesh.corner_count() - 2 * mesh.face_count();
    counts.vertices += mesh.vertex_count();
}

} // namespace

MeshCounts count_selected(const Scene& scene, const std::vector<std::uint8_t>& selected) {
    MeshCounts counts;
    for (std::size_t p = 0; p < scene.parts.size(); ++p)
        if (selected[p]) add_counts(counts, scene.parts[p].mesh);
    return counts;
}

} // namespace facetmill

namespace facetmill::simplification {

namespace {

using Method = SimplifySettings::Method;

/// A proportional share of a total count, rounded down; an empty total stays empty.
std::optional<std::size_t> share(std::optional<std::size_t> whole, std::size_t own, std::size_t all) {
    if (!whole || own == all || all == 0) return whole;
    return static_cast<std::size_t>(static_cast<double>(*whole) *
                                    (static_cast<double>(own) / static_cast<double>(all)));
}

/// The size that determines a part's share of the samples.
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

/// Distributes `all` samples to parts that are measured separately. Half are distributed by area, half by the
/// number of triangles, rounded up; all by triangles if there is no finite area. A single part gets all.
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

bool fits(const PartSet& set, const PartsPlan& plan) {
    std::vector<const Mesh*> meshes;
    for (const std::size_t p : set) {
        const Part& part = plan.scene.parts[p];
        if (!plan.o.selected[p] || part.transform != plan.scene.parts[set.front()].transform) return false;
        meshes.push_back(&part.mesh);
    }
    return can_simplify_jointly(meshes, plan.o.all);
}

/// Finds the sets of parts to merge, and the vertices that stay because another part shares them.
void find_sets(PartsPlan& plan) {
    const SimplifySettings& s = plan.o.all;
    const auto& parts = plan.scene.parts;
    const bool matches_anyway = s.lock.boundary || s.method == Method::constrained;
    if (parts.size() < 2 || matches_anyway || s.method == Method::cluster) return;
    std::vector<PlacedMesh> placed;
    placed.reserve(parts.size());
    for (const Part& part : parts) placed.push_back({&part.mesh, part.transform});
    plan.contacts = find_contacts(placed);
    plan.set_of.assign(parts.size(), nullptr);
    for (const PartSet& set : plan.contacts.sets)
        if (fits(set, plan))
            for (const std::size_t p : set) plan.set_of[p] = &set;
}

/// Distributes the samples among the simplified parts.
void share_samples(PartsPlan& plan) {
    const auto& parts = plan.scene.parts;
    plan.samples.assign(parts.size(), 0);
    if (!plan.measures() && !plan.o.all.max_error) return;
    std::vector<std::size_t> selected;
    for (std::size_t p = 0; p < parts.size(); ++p)
        if (plan.o.selected[p]) selected.push_back(p);
    std::vector<SampledSize> sizes(selected.size(), {0, 1});
    for (std::size_t i = 0; selected.size() > 1 && i < selected.size(); ++i)
        sizes[i] = sampled_size(surface_of(parts[selected[i]]));
    const auto shares = shared_samples(DeviationSettings{}.samples, sizes);
    for (std::size_t i = 0; i < selected.size(); ++i) plan.samples[selected[i]] = shares[i];
}

/// Finds parts that share the result of an earlier part with the same mesh. They share its measurements too
/// if they differ only by a rigid motion.
void find_repeats(PartsPlan& plan) {
    const SimplifySettings& s = plan.o.all;
    const bool by_size = s.max_error || s.constraints.hausdorff > 0 || s.max_quadric_error;
    const auto key = [&](std::size_t p) {
        const Transform& to_world = plan.scene.parts[p].transform;
        const bool touches = !plan.contacts.shared.empty() && !plan.contacts.shared[p].empty();
        const bool alone =
            touches || !plan.o.selected[p] || !s.lock.body.empty(); // the position of these parts matters
        const double scale = by_size           ? greatest_stretch(to_world)
                             : plan.o.by_error ? ordering_scale(to_world)
                                               : 1;
        return std::pair(alone ? p + 1 : 0, facetmill::key_of(scale));
    };
    plan.work = DistinctParts(plan.scene).split_by(key);
    plan.measured_as =
        plan.work.split_by([&](std::size_t p) { return axes_in_world(plan.scene.parts[p].transform); }).first;
}

} // namespace

double ordering_scale(const Transform& to_world) {
    int exponent = 0;
    const double mantissa = std::frexp(greatest_stretch(to_world), &exponent);
    return std::ldexp(std::round(std::ldexp(mantissa, 20)), exponent - 20);
}

PartsPlan plan_parts(const Scene& scene, const SimplifyPartsSettings& settings) {
    PartsPlan plan{scene, settings, count_selected(scene, settings.selected)};
    find_sets(plan);
    share_samples(plan);
    find_repeats(plan);
    return plan;
}

SimplifySettings settings_for(const PartSet& set, const PartsPlan& plan) {
    const Transform& to_world = plan.scene.parts[set.front()].transform;
    const double scale = greatest_stretch(to_world);
    SimplifySettings s = plan.o.all;
    MeshCounts own;
    for (const std::size_t p : set) add_counts(own, plan.scene.parts[p].mesh);
    s.faces = share(s.faces, own.triangles, plan.all.triangles);
    s.vertices = share(s.vertices, own.vertices, plan.all.vertices);
    for (auto* length : {&s.max_error, &s.max_quadric_error})
        if (*length) **length /= scale;
    if (s.constraints.hausdorff > 0) s.constraints.hausdorff /= scale;
    if (plan.o.max_of_diagonal) {
        Box box;
        for (const std::size_t p : set) box.add(drawn_box(plan.scene.parts[p].mesh));
        s.max_quadric_error = *plan.o.max_of_diagonal * diagonal(box);
    }
    if (!(s.max_quadric_error > 0.0)) s.max_quadric_error.reset(); // 0 for a single point
    for (Plane& plane : s.lock.body) plane = pulled_back(plane, to_world);
    if (set.size() == 1 && !plan.contacts.shared.empty()) s.lock.vertices = plan.contacts.shared[set.front()];
    s.samples = 0;
    for (const std::size_t p : set) s.samples += plan.samples[p];
    return s;
}

} // namespace facetmill::simplification
