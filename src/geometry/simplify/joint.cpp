#include "geometry/simplify/joint.hpp"

#include "geometry/edit/surgery.hpp"
#include "geometry/spatial/box_tree.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <map>

namespace facetmill {

namespace {

constexpr std::string_view member_attribute =
    "simplify_member"; // face attribute of the joined mesh: the member's number

/// A boundary edge by the world positions of its ends, the lower first.
struct PlacedEdge {
    Vec3 low, high;
    Index from, to; ///< the vertices at these positions
    std::size_t mesh;
};

auto order_of(const Vec3& p) { return std::tie(p.x, p.y, p.z); }
auto place_of(const PlacedEdge& e) { return std::tuple(order_of(e.low), order_of(e.high)); }

void add_open_edges(const PlacedMesh& placed, std::size_t number, std::vector<PlacedEdge>& edges) {
    const EdgeTable table = build_edges(*placed.mesh);
    for (Index e = 0; e < table.size(); ++e) {
        if (table.corners_of(e).size() != 1) continue;
        const auto [u, v] = table.edges[e];
        PlacedEdge edge{placed.to_world.point(placed.mesh->positions[u]),
                        placed.to_world.point(placed.mesh->positions[v]), u, v, number};
        if (!is_finite(edge.low) || !is_finite(edge.high)) continue;
        if (order_of(edge.high) < order_of(edge.low)) {
            std::swap(edge.low, edge.high);
            std::swap(edge.from, edge.to);
        }
        edges.push_back(edge);
    }
}

/// The boundary edges of all meshes that may touch another mesh.
std::vector<PlacedEdge> open_edges(std::span<const PlacedMesh> meshes) {
    std::vector<Box> boxes(meshes.size());
    for (std::size_t i = 0; i < meshes.size(); ++i)
        for (const Vec3& p : meshes[i].mesh->positions) boxes[i].add(meshes[i].to_world.point(p));
    const BoxTree tree(boxes);
    std::vector<PlacedEdge> edges;
    for (std::size_t i = 0; i < meshes.size(); ++i)
        if (tree.any_of(boxes[i], [i](Index k) { return k != i; })) add_open_edges(meshes[i], i, edges);
    std::sort(edges.begin(), edges.end(), [](const PlacedEdge& a, const PlacedEdge& b) {
        return std::tuple(place_of(a), a.mesh, a.from, a.to) < std::tuple(place_of(b), b.mesh, b.from, b.to);
    });
    return edges;
}

NormalSeams::Shading shading_of(const Mesh& mesh, double feature_angle) {
    if (!mesh.has_seams() || !mesh.find("NORMAL", Domain::wedge)) return NormalSeams::Shading::as_given;
    Mesh copy = mesh;
    return merge_normal_seams(copy, feature_angle).shading;
}

bool same_attributes(const Mesh& a, const Mesh& b) {
    return std::equal(a.attributes.begin(), a.attributes.end(), b.attributes.begin(), b.attributes.end(),
                      [](const Attribute& x, const Attribute& y) {
                          return x.name == y.name && x.domain == y.domain && x.role == y.role &&
                                 x.components == y.components && x.normalised == y.normalised &&
                                 x.data.index() == y.data.index();
                      });
}

std::size_t used_vertices(const Mesh& mesh) {
    std::vector<std::uint8_t> used(mesh.vertex_count());
    for (Index c = 0; c < mesh.corner_count(); ++c) used[mesh.vertex(c)] = 1;
    return static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
}

} // namespace

namespace simplification {

Mesh joined(std::span<const Mesh* const> meshes) {
    Mesh all;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        Mesh one = *meshes[i];
        one.primitives.clear();
        one.attributes.push_back(
            {std::string(member_attribute), Domain::face, Role::index, 1, false,
             std::vector<std::uint32_t>(one.face_count(), static_cast<std::uint32_t>(i))});
        append(all, one);
    }
    return all;
}

std::vector<SimplifyResult> split_up(SimplifyResult all, std::span<const Mesh* const> meshes) {
    std::vector<Mesh> pieces(meshes.size());
    const Attribute* member = all.mesh.find(member_attribute, Domain::face);
    if (!all.unchanged && member)
        pieces = separated(all.mesh, std::get<std::vector<std::uint32_t>>(member->data), meshes.size());
    all.mesh = {};
    forget_change(all.changes, member_attribute);
    std::vector<SimplifyResult> results(meshes.size(), all);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        SimplifyResult& r = results[i];
        const Mesh& given = *meshes[i];
        r.faces_given = given.face_count();
        r.faces_before = given.corner_count() - 2 * given.face_count();
        r.vertices_before = used_vertices(given);
        if (all.unchanged) {
            r.mesh = given;
            r.faces_after = r.faces_before;
            r.vertices_after = r.vertices_before;
            continue;
        }
        r.mesh = std::move(pieces[i]);
        r.mesh.drop(member_attribute, Domain::face);
        r.mesh.primitives = given.primitives;
        r.faces_after = r.mesh.face_count();
        r.vertices_after = r.mesh.vertex_count();
    }
    return results;
}

} // namespace simplification

Contacts find_contacts(std::span<const PlacedMesh> meshes) {
    const std::vector<PlacedEdge> edges = open_edges(meshes);
    Contacts contacts;
    contacts.shared.resize(meshes.size());
    DisjointSets sets(meshes.size());
    const auto share = [&](const PlacedEdge& e) {
        auto& shared = contacts.shared[e.mesh];
        shared.resize(meshes[e.mesh].mesh->vertex_count());
        shared[e.from] = shared[e.to] = 1;
    };
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && place_of(edges[end]) == place_of(edges[begin])) ++end;
        if (edges[begin].mesh == edges[end - 1].mesh) continue;
        for (std::size_t i = begin; i < end; ++i) {
            share(edges[i]);
            sets.join(static_cast<Index>(edges[begin].mesh), static_cast<Index>(edges[i].mesh));
        }
    }
    std::map<Index, std::vector<std::size_t>> by_root;
    for (std::size_t i = 0; i < meshes.size(); ++i) by_root[sets.find(static_cast<Index>(i))].push_back(i);
    for (auto& [root, members] : by_root)
        if (members.size() > 1) contacts.sets.push_back(std::move(members));
    return contacts;
}

bool can_simplify_jointly(std::span<const Mesh* const> meshes, const SimplifySettings& settings) {
    return std::all_of(meshes.begin(), meshes.end(), [&](const Mesh* mesh) {
        return same_attributes(*meshes.front(), *mesh) &&
               shading_of(*meshes.front(), settings.feature_angle) ==
                   shading_of(*mesh, settings.feature_angle);
    });
}

std::vector<std::vector<SimplifyResult>> simplify_jointly(std::span<const Mesh* const> meshes,
                                                          const SimplifySettings& settings) {
    std::vector<SimplifyResult> all;
    if (settings.levels.empty())
        all.push_back(simplify(simplification::joined(meshes), settings));
    else
        all = simplify_levels(simplification::joined(meshes), settings);
    std::vector<std::vector<SimplifyResult>> results;
    results.reserve(all.size());
    for (SimplifyResult& r : all) results.push_back(simplification::split_up(std::move(r), meshes));
    return results;
}

} // namespace facetmill
