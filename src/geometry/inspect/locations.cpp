// Finds the locations where properties of connectivity, faces and pairs fail, and the keys of locations.
#include "base/math/predicates.hpp"
#include "base/math/random.hpp"
#include "base/sort_unique.hpp"
#include "geometry/edit/t_junctions.hpp"
#include "geometry/inspect/measures.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/orient/orient.hpp"
#include "mesh/lines.hpp"
#include "mesh/placement.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

namespace facetmill {

namespace {

std::uint64_t bits_of(double x) {
    if (x == 0) return 0;
    return std::bit_cast<std::uint64_t>(x == x ? x : std::numeric_limits<double>::quiet_NaN());
}

bool is_lower(const Vec3& a, const Vec3& b) {
    for (std::size_t i = 0; i < 3; ++i)
        if (a[i] != b[i]) return a[i] < b[i];
    return false;
}

/// A key independent of the order of the ends, because addition is commutative. The last hash distinguishes
/// ends with equal sums.
std::uint64_t key_of_edge(const Vec3& a, const Vec3& b) {
    return hashed(2, inspect_room::key_of_point(a) + inspect_room::key_of_point(b));
}

/// A key of the set of the face's corners, independent of their order and direction.
std::uint64_t key_of_face(const Mesh& mesh, Index f) {
    std::uint64_t sum = 0;
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
        sum += inspect_room::key_of_point(mesh.point(c));
    return hashed(hashed(3, mesh.face_size(f)), sum);
}

std::uint64_t key_of_pair(const Mesh& mesh, Index f, Index g) {
    return hashed(4, key_of_face(mesh, f) + key_of_face(mesh, g));
}

/// The number of faces that run along an edge from low to high, and the number that run back.
std::array<int, 2> directions(const Mesh& mesh, const EdgeTable& edges, Index e) {
    std::array<int, 2> ways{};
    for (const Index c : edges.corners_of(e)) ++ways[mesh.vertex(c) == edges.edges[e].low ? 0 : 1];
    return ways;
}

template <class Fails>
std::vector<Location> locations_of_edges(const Mesh& mesh, std::size_t limit, Fails fails) {
    const EdgeTable edges = build_edges(mesh);
    const auto faces = corner_faces(mesh);
    std::vector<Location> found;
    for (Index e = 0; e < edges.size() && found.size() < limit; ++e) {
        const auto [forth, back] = directions(mesh, edges, e);
        if (!fails(forth, back)) continue;
        const Vec3 &low = mesh.positions[edges.edges[e].low], &high = mesh.positions[edges.edges[e].high];
        found.push_back({.face = faces[edges.corners_of(e).front()],
                         .at = mix(low, high, 0.5),
                         .key = key_of_edge(low, high)});
    }
    return found;
}

/// Vertices whose number of fans fails.
template <class Fails>
std::vector<Location> locations_of_vertices(const Mesh& mesh, std::size_t limit, Fails fails) {
    const auto fans = fans_at_vertices(mesh, build_edges(mesh));
    const auto faces = inspect_room::faces_at_vertices(mesh);
    std::vector<Location> found;
    for (Index v = 0; v < fans.size() && found.size() < limit; ++v)
        if (fails(fans[v])) found.push_back(inspect_room::location_of_vertex(mesh, v, faces));
    return found;
}

/// The set of vertices of a face, sorted.
void vertex_set(const Mesh& mesh, Index f, std::vector<Index>& set) {
    set.clear();
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) set.push_back(mesh.vertex(c));
    sort_unique(set);
}

struct HashedFace {
    std::uint64_t hash;
    Index face;
};

/// All faces, sorted by the hash of their vertex sets, then by face.
std::vector<HashedFace> hashed_faces(const Mesh& mesh) {
    std::vector<HashedFace> faces(mesh.face_count());
    parallel_chunks(faces.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<Index> set;
        for (std::size_t f = begin; f < end; ++f) {
            vertex_set(mesh, static_cast<Index>(f), set);
            std::uint64_t h = set.size();
            for (const Index v : set) h = hashed(h, v);
            faces[f] = {h, static_cast<Index>(f)};
        }
    });
    constexpr std::size_t few = 2048; // a radix sort of fewer faces would count more buckets than faces
    if (faces.size() <= few)
        std::sort(faces.begin(), faces.end(), [](const HashedFace& a, const HashedFace& b) {
            return a.hash != b.hash ? a.hash < b.hash : a.face < b.face;
        });
    else
        radix_sort(faces, [](const HashedFace& f) { return f.hash; });
    return faces;
}

/// Whether two faces with equal hashes have the same set of vertices.
bool same_set(const Mesh& mesh, Index a, Index b) {
    std::vector<Index> set_a, set_b;
    vertex_set(mesh, a, set_a);
    vertex_set(mesh, b, set_b);
    return set_a == set_b;
}

/// True if the cross product of u and w is certainly nonzero, by the filter of orientation_2d.
bool surely_not_parallel(const Vec3& u, const Vec3& w) {
    const auto sure = [](double left, double right) {
        const double det = std::abs(left - right);
        return det > orientation_error * (std::abs(left) + std::abs(right)) && det > orientation_smallest;
    };
    return sure(u.x * w.y, u.y * w.x) || sure(u.y * w.z, u.z * w.y) || sure(u.z * w.x, u.x * w.z);
}

} // namespace

bool is_degenerate(const Vec3& a, const Vec3& b, const Vec3& c) {
    return !surely_not_parallel(b - a, c - a) && collinear(a, b, c);
}

bool is_degenerate(const Mesh& mesh, Index f) {
    const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
    // Every other corner must be on the line through the first corner and the first different corner.
    const Vec3& p = mesh.point(begin);
    Index other = begin + 1;
    while (other < end && mesh.point(other) == p) ++other;
    if (other + 1 >= end) return true;
    const Vec3& q = mesh.point(other);
    for (Index c = other + 1; c < end; ++c)
        if (!is_degenerate(p, q, mesh.point(c))) return false;
    return true;
}

Location location_of(const Mesh& mesh, Index f) {
    return {.face = f, .at = corner_mean(mesh, f), .key = key_of_face(mesh, f)};
}

std::vector<std::uint64_t> keys_of_components(const Mesh& mesh, const std::vector<Index>& of_face,
                                              std::size_t count) {
    std::vector<Vec3> lowest(count, {HUGE_VAL, HUGE_VAL, HUGE_VAL});
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            if (is_lower(mesh.point(c), lowest[of_face[f]])) lowest[of_face[f]] = mesh.point(c);
    std::vector<std::uint64_t> keys;
    keys.reserve(lowest.size());
    for (const Vec3& p : lowest) keys.push_back(hashed(5, inspect_room::key_of_point(p)));
    return keys;
}

std::vector<Index> fans_at_vertices(const Mesh& mesh, const EdgeTable& edges) {
    const VertexLists lists = corners_at_vertices(mesh);
    const auto faces = corner_faces(mesh);
    std::vector<Index> fans(mesh.vertex_count());
    parallel_chunks(mesh.vertex_count(), [&](std::size_t begin, std::size_t end) {
        std::vector<std::pair<Index, Index>>
            ends; // pairs of edge and position of the corner in the vertex's list
        std::vector<Index> parent;
        const auto root = [&](Index i) {
            while (parent[i] != i) i = parent[i] = parent[parent[i]];
            return i;
        };
        for (std::size_t v = begin; v < end; ++v) {
            const auto corners = lists.of(static_cast<Index>(v));
            ends.clear();
            parent.resize(corners.size());
            for (Index i = 0; i < corners.size(); ++i) {
                parent[i] = i;
                const Index c = corners[i];
                for (const Index along : {c, previous_corner(mesh, faces[c], c)})
                    if (edges.corner_edge[along] != none) ends.emplace_back(edges.corner_edge[along], i);
            }
            std::sort(ends.begin(), ends.end());
            Index count = static_cast<Index>(corners.size());
            for (std::size_t k = 1; k < ends.size(); ++k) {
                if (ends[k].first != ends[k - 1].first) continue;
                const Index a = root(ends[k - 1].second), b = root(ends[k].second);
                if (a == b) continue;
                parent[std::max(a, b)] = std::min(a, b);
                --count;
            }
            fans[v] = count;
        }
    });
    return fans;
}

std::vector<Index> duplicate_faces(const Mesh& mesh) {
    const auto faces = hashed_faces(mesh);
    std::vector<Index> duplicates;
    for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
        while (end < faces.size() && faces[end].hash == faces[begin].hash) ++end;
        for (std::size_t i = begin + 1; i < end;
             ++i) // different sets may have equal hashes by chance, so all faces are compared
            for (std::size_t j = begin; j < i; ++j)
                if (same_set(mesh, faces[i].face, faces[j].face)) {
                    duplicates.push_back(faces[i].face);
                    break;
                }
    }
    std::sort(duplicates.begin(), duplicates.end());
    return duplicates;
}

namespace inspect_room {

std::uint64_t key_of_point(const Vec3& p) {
    return hashed(hashed(hashed(1, bits_of(p.x)), bits_of(p.y)), bits_of(p.z));
}

std::vector<Index> faces_at_vertices(const Mesh& mesh) {
    std::vector<Index> faces(mesh.vertex_count(), none);
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            faces[mesh.vertex(c)] = std::min(faces[mesh.vertex(c)], f);
    return faces;
}

Location location_of_vertex(const Mesh& mesh, Index v, const std::vector<Index>& faces) {
    return {.face = faces[v], .at = mesh.positions[v], .key = key_of_point(mesh.positions[v])};
}

std::vector<Location> locations_of_pairs(const Mesh& mesh, const Pairs& pairs, std::size_t limit) {
    std::vector<Location> found;
    for (const auto& [f, g] : pairs) {
        if (found.size() == limit) break;
        found.push_back(location_of(mesh, f));
        found.back().with = g;
        found.back().key = key_of_pair(mesh, f, g);
    }
    return found;
}

std::vector<Location> uncancelled_edges(const Mesh& mesh, const LocationQuery& query) {
    return locations_of_edges(mesh, query.limit, [](int forth, int back) { return forth != back; });
}

std::vector<Location> crowded_edges(const Mesh& mesh, const LocationQuery& query) {
    return locations_of_edges(mesh, query.limit, [](int forth, int back) { return forth + back > 2; });
}

std::vector<Location> disagreeing_edges(const Mesh& mesh, const LocationQuery& query) {
    return locations_of_edges(mesh, query.limit,
                              [](int forth, int back) { return std::abs(forth - back) > 1; });
}

std::vector<Location> vertices_of_several_fans(const Mesh& mesh, const LocationQuery& query) {
    return locations_of_vertices(mesh, query.limit, [](Index fans) { return fans > 1; });
}

std::vector<Index> vertices_without_lines(const Mesh& mesh) {
    const std::vector<std::uint8_t> used = marked_ends_of_lines(mesh);
    std::vector<Index> others;
    for (Index v = 0; v < used.size(); ++v)
        if (!used[v]) others.push_back(v);
    return others;
}

std::vector<Location> isolated_vertices(const Mesh& mesh, const LocationQuery& query) {
    if (mesh.lines.empty())
        return locations_of_vertices(mesh, query.limit, [](Index fans) { return fans == 0; });
    const auto faces = inspect_room::faces_at_vertices(mesh);
    std::vector<Location> found;
    for (const Index v : vertices_without_lines(mesh))
        if (found.size() < query.limit) found.push_back(inspect_room::location_of_vertex(mesh, v, faces));
    return found;
}

std::vector<Location> non_manifold_locations(const Mesh& mesh, const LocationQuery& query) {
    auto found = crowded_edges(mesh, query);
    const auto more = vertices_of_several_fans(mesh, {query.limit - found.size()});
    found.insert(found.end(), more.begin(), more.end());
    return found;
}

std::vector<Location> faces_without_area(const Mesh& mesh, const LocationQuery& query) {
    std::vector<Location> found;
    for (Index f = 0; f < mesh.face_count() && found.size() < query.limit; ++f)
        if (is_degenerate(mesh, f)) found.push_back(location_of(mesh, f));
    return found;
}

std::vector<Location> repeated_faces(const Mesh& mesh, const LocationQuery& query) {
    std::vector<Location> found;
    for (const Index f : duplicate_faces(mesh)) {
        if (found.size() == query.limit) break;
        found.push_back(location_of(mesh, f));
    }
    return found;
}

std::vector<Location> components(const Mesh& mesh, const LocationQuery& query) {
    const Components all = face_components(mesh);
    const auto keys = keys_of_components(mesh, all.of_face, all.count);
    std::vector<Location> found;
    for (Index f = 0; f < mesh.face_count() && found.size() < query.limit; ++f)
        if (all.of_face[f] == found.size()) { // components are numbered by first face
            found.push_back(location_of(mesh, f));
            found.back().key = keys[found.size() - 1];
        }
    return found;
}

std::vector<Location> intersecting_pairs(const Mesh& mesh, const LocationQuery& query) {
    const auto found = find_self_intersections(mesh, {.limit = query.limit, .separate_touching = true});
    return locations_of_pairs(mesh, found.pairs, query.limit);
}

std::vector<Location> touching_pairs(const Mesh& mesh, const LocationQuery& query) {
    const auto found = find_self_intersections(mesh, {.limit = query.limit, .separate_touching = true});
    return locations_of_pairs(mesh, found.touching_pairs, query.limit);
}

std::vector<Index> inward_faces(const Mesh& mesh) {
    const OrientResult r = orient(bare(mesh), {});
    std::vector<Index> faces;
    for (const auto& component : r.components)
        if (!component.orientable || component.flipped > 0) faces.push_back(component.first_face);
    return faces;
}

std::vector<Location> inward_components(const Mesh& mesh, const LocationQuery& query) {
    const Components all = face_components(mesh, false);
    const auto keys = keys_of_components(mesh, all.of_face, all.count);
    std::vector<Location> found;
    for (const Index f : inward_faces(mesh)) {
        if (found.size() == query.limit) break;
        found.push_back(location_of(mesh, f));
        found.back().key = keys[all.of_face[f]];
    }
    return found;
}

std::optional<double> count_t_junctions(const Measured& mesh) {
    return static_cast<double>(find_t_junctions(mesh.world, 0).size());
}

std::vector<Location> t_junctions(const Mesh& mesh, const LocationQuery& query) {
    const auto faces = corner_faces(mesh);
    std::vector<Location> found;
    for (const auto& junction : find_t_junctions(mesh, 0)) {
        if (found.size() == query.limit) break;
        const Vec3& at = mesh.positions[junction.vertex];
        const Index face = faces[junction.corner];
        const Vec3 &from = mesh.point(junction.corner),
                   &to = mesh.point(next_corner(mesh, face, junction.corner));
        found.push_back({.face = face, .at = at, .key = hashed(key_of_point(at), key_of_edge(from, to))});
    }
    return found;
}

} // namespace inspect_room

} // namespace facetmill
