#include "io/gltf/read/pose_mesh.hpp"

#include "io/gltf/read/skins.hpp"
#include "mesh/transform.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace facetmill::io::gltf {

std::vector<Transform> joint_matrices(Source& source, std::size_t node,
                                      const std::vector<Transform>& worlds) {
    const Json& json = source.json();
    const auto skin = index_at(item(json, "nodes", node).json(), "skin", count_of(json, "skins"));
    if (!skin) return {};
    const JsonCursor place = item(json, "skins", *skin);
    const JsonCursor nodes = place.at("joints");
    const std::vector<float> bind = bind_matrices(source, place, nodes.size());
    std::vector<Transform> out;
    out.reserve(nodes.size());
    for (std::size_t j = 0; j < nodes.size(); ++j)
        out.push_back(worlds[nodes.at(j).index(worlds.size(), "node")] * from_columns(&bind[16 * j]));
    return out;
}

std::vector<double> default_weights(const Json& json, const Part& part) {
    const auto of = [&](const char* list, int index) -> std::optional<JsonCursor> {
        if (index < 0 || static_cast<std::size_t>(index) >= count_of(json, list)) return {};
        return item(json, list, static_cast<std::size_t>(index)).find("weights");
    };
    auto place = of("nodes", part.node);
    if (!place) place = of("meshes", part.source_mesh);
    std::vector<double> out;
    for (std::size_t i = 0; place && i < place->size(); ++i) out.push_back(place->at(i).real());
    return out;
}

namespace {

Vec3 vector_at(const Attribute& a, std::size_t i) { return {a.value(i, 0), a.value(i, 1), a.value(i, 2)}; }

/// A wedge of each vertex.
std::vector<Index> wedge_of_vertices(const Mesh& mesh) {
    std::vector<Index> out(mesh.vertex_count(), none);
    for (Index w = 0; w < mesh.wedge_count(); ++w)
        if (Index& of = out[mesh.vertex_of_wedge(w)]; of == none) of = w;
    return out;
}

/// Converts a direction attribute to float32, element by element: changed(element, value).
template <class Changed>
void change_directions(Attribute& a, Changed&& changed) {
    std::vector<float> data(a.size() * static_cast<std::size_t>(a.components));
    parallel_for(a.size(), [&](std::size_t i) {
        const Vec3 value = changed(i, vector_at(a, i));
        for (int c = 0; c < a.components; ++c)
            data[i * static_cast<std::size_t>(a.components) + static_cast<std::size_t>(c)] =
                static_cast<float>(c < 3 ? value[static_cast<std::size_t>(c)] : a.value(i, c));
    });
    a.data = std::move(data);
    a.normalised = false;
}

Attribute* directions(Mesh& mesh, const char* name) {
    for (Attribute& a : mesh.attributes)
        if (a.name == name && a.domain == Domain::wedge && a.components >= 3) return &a;
    return nullptr;
}

} // namespace

bool morph(Mesh& mesh, const std::vector<double>& weights) {
    bool any = false;
    const std::vector<Index> wedges = wedge_of_vertices(mesh);
    for (std::size_t t = 0; t < weights.size(); ++t) {
        const auto target = [&](const char* name) {
            const Attribute* a = mesh.find(fmt::format("TARGET_{}_{}", t, name), Domain::wedge);
            return a && a->components == 3 && weights[t] != 0 ? a : nullptr;
        };
        if (const Attribute* by = target("POSITION")) {
            any = true;
            for (std::size_t v = 0; v < wedges.size(); ++v)
                if (wedges[v] != none) mesh.positions[v] += vector_at(*by, wedges[v]) * weights[t];
        }
        for (const char* name : {"NORMAL", "TANGENT"}) {
            const Attribute* by = target(name);
            Attribute* a = directions(mesh, name);
            if (!by || !a) continue;
            any = true;
            change_directions(
                *a, [&](std::size_t i, const Vec3& n) { return n + vector_at(*by, i) * weights[t]; });
        }
    }
    return any;
}

namespace {

/// The joints and weights of one set, JOINTS_n and WEIGHTS_n.
struct SkinSet {
    const Attribute *joints, *weights;
};

std::vector<SkinSet> skin_sets(const Mesh& mesh) {
    std::vector<SkinSet> sets;
    for (int n = 0;; ++n) {
        const Attribute* joints = mesh.find(fmt::format("JOINTS_{}", n), Domain::wedge);
        const Attribute* weights = mesh.find(fmt::format("WEIGHTS_{}", n), Domain::wedge);
        if (!joints || !weights || joints->components != 4 || weights->components != 4) return sets;
        sets.push_back({joints, weights});
    }
}

/// The weighted mean of a wedge's joint matrices; the first joint's matrix if all weights are 0.
Transform mixed(const std::vector<SkinSet>& sets, const std::vector<Transform>& joints, Index wedge) {
    Transform sum;
    double total = 0;
    const auto add = [&](double joint, double weight) {
        if (!(weight > 0) || !(joint >= 0) || joint >= static_cast<double>(joints.size())) return;
        const Transform& m = joints[static_cast<std::size_t>(joint)];
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t column = 0; column < 4; ++column)
                sum.m[row][column] = (total > 0 ? sum.m[row][column] : 0) + weight * m.m[row][column];
        total += weight;
    };
    for (const SkinSet& set : sets)
        for (int k = 0; k < 4; ++k) add(set.joints->value(wedge, k), set.weights->value(wedge, k));
    if (!(total > 0)) add(sets[0].joints->value(wedge, 0), 1);
    for (auto& row : sum.m)
        for (double& x : row) x /= total > 0 ? total : 1;
    return sum;
}

} // namespace

bool bend(Mesh& mesh, const std::vector<Transform>& joints) {
    const std::vector<SkinSet> sets = skin_sets(mesh);
    if (joints.empty() || sets.empty()) return false;
    std::vector<Transform> of_wedges(mesh.wedge_count());
    parallel_for(of_wedges.size(),
                 [&](std::size_t w) { of_wedges[w] = mixed(sets, joints, static_cast<Index>(w)); });
    const std::vector<Index> wedges = wedge_of_vertices(mesh);
    parallel_for(wedges.size(), [&](std::size_t v) {
        if (wedges[v] != none) mesh.positions[v] = of_wedges[wedges[v]].point(mesh.positions[v]);
    });
    if (Attribute* normals = directions(mesh, "NORMAL"))
        change_directions(*normals, [&](std::size_t w, const Vec3& n) {
            return normalised(moved_normal(of_wedges[w], n));
        });
    if (Attribute* tangents = directions(mesh, "TANGENT"))
        change_directions(*tangents,
                          [&](std::size_t w, const Vec3& t) { return normalised(of_wedges[w].vector(t)); });
    return true;
}

bool has_targets(const Mesh& mesh) {
    return std::any_of(mesh.attributes.begin(), mesh.attributes.end(),
                       [](const Attribute& a) { return a.role == Role::morph_vector; });
}

} // namespace facetmill::io::gltf
