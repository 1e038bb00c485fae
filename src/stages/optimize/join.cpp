#include "stages/optimize/join.hpp"

#include "geometry/edit/equal_wedges.hpp"
#include "geometry/edit/primitives.hpp"
#include "io/gltf/gltf.hpp"
#include "mesh/topology.hpp"
#include "mesh/transform.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <set>

namespace facetmill::optimize_stage {

namespace {

std::set<Index> materials_of(const Mesh& mesh) {
    std::set<Index> materials;
    for (const Primitive& p : mesh.primitives) materials.insert(p.material);
    if (materials.empty()) materials.insert(none);
    return materials;
}

/// The kinds of attributes, which two meshes must share to be merged. Empty for meshes whose primitives have
/// further data.
std::string kind_of(const Mesh& mesh) {
    const auto has_data = [](const Primitive& p) { return !p.json.empty(); };
    if (std::any_of(mesh.primitives.begin(), mesh.primitives.end(), has_data)) return "";
    std::set<std::string> attributes{"of"}; // in any order
    for (const Attribute& a : mesh.attributes)
        if (a.name != primitive_attribute)
            attributes.insert(fmt::format("{} {} {} {} {} {}", a.name, int(a.domain), int(a.role),
                                          a.components, a.normalised, a.data.index()));
    return fmt::format("{}", fmt::join(attributes, ", "));
}

/// The scale of a transform along all directions, to a millionth. Equal keys keep lengths equal.
std::string scale_key(const Transform& t) {
    const Vec3 axes[3] = {t.vector({1, 0, 0}), t.vector({0, 1, 0}), t.vector({0, 0, 1})};
    double whole = 0;
    for (const Vec3& a : axes) whole += dot(a, a);
    std::string key = fmt::format(" | {:.6g}", whole);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = i; j < 3; ++j)
            key += fmt::format(" {:.0f}", std::floor(dot(axes[i], axes[j]) / whole * 1e6 + 0.5) + 0.0);
    return key;
}

} // namespace

std::vector<JoinedParts> groups_to_join(const Scene& scene, const std::vector<std::size_t>& candidates) {
    std::map<std::pair<std::string, Index>, Index> known; // the first candidate of a kind with a material
    DisjointSets sets(static_cast<Index>(candidates.size()));
    const auto thick = io::thicknesses(scene);
    for (Index c = 0; c < candidates.size(); ++c) {
        const std::size_t i = candidates[c];
        std::string kind = kind_of(scene.parts[i].mesh);
        if (kind.empty()) continue;
        if (!thick[i].empty()) kind += scale_key(scene.parts[i].transform);
        for (const Index material : materials_of(scene.parts[i].mesh))
            sets.join(known.try_emplace({kind, material}, c).first->second, c);
    }
    std::map<Index, JoinedParts> by_set;
    for (Index c = 0; c < candidates.size(); ++c) {
        const auto [group, first] = by_set.try_emplace(sets.find(c), JoinedParts{candidates[c], {}});
        if (!first) group->second.others.push_back(candidates[c]);
    }
    std::vector<JoinedParts> groups;
    for (auto& [set, group] : by_set)
        if (!group.others.empty()) groups.push_back(std::move(group));
    std::sort(groups.begin(), groups.end(),
              [](const JoinedParts& a, const JoinedParts& b) { return a.first < b.first; });
    return groups;
}

std::vector<JoinedParts>
groups_standing_together(const Scene& scene, const std::vector<std::vector<std::size_t>>& parts_of_meshes) {
    std::map<std::string, std::vector<const std::vector<std::size_t>*>> by_kind;
    for (const std::vector<std::size_t>& parts : parts_of_meshes) {
        std::string kind = kind_of(scene.parts[parts.front()].mesh);
        if (kind.empty()) continue;
        kind += fmt::format(" | {} |", fmt::join(materials_of(scene.parts[parts.front()].mesh), " "));
        for (const std::size_t i : parts)
            for (const auto& row : scene.parts[i].transform.m)
                for (const double x : row) kind += fmt::format(" {}", x);
        by_kind[kind].push_back(&parts);
    }
    std::vector<JoinedParts> groups;
    for (const auto& [kind, meshes] : by_kind)
        for (std::size_t place = 0; meshes.size() > 1 && place < meshes.front()->size(); ++place) {
            JoinedParts& group = groups.emplace_back(JoinedParts{(*meshes.front())[place], {}});
            for (std::size_t m = 1; m < meshes.size(); ++m) group.others.push_back((*meshes[m])[place]);
        }
    std::sort(groups.begin(), groups.end(),
              [](const JoinedParts& a, const JoinedParts& b) { return a.first < b.first; });
    return groups;
}

void join(Scene& scene, const JoinedParts& group) {
    Part& first = scene.parts[group.first];
    const auto into = inverse(first.transform);
    for (const std::size_t i : group.others) {
        Part& other = scene.parts[i];
        // Parts with equal transforms keep their exact coordinates.
        if (into && other.transform != first.transform) apply(other.mesh, *into * other.transform);
        append(first.mesh, other.mesh);
        other.mesh = {};
    }
    first.changed = true;
    first.cuts.reset();
    join_primitives(first.mesh);
    weld_exact(first.mesh);
    merge_and_drop_wedges(first.mesh);
}

} // namespace facetmill::optimize_stage
