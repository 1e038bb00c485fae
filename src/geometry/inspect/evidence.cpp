#include "geometry/inspect/evidence.hpp"

#include "base/parallel.hpp"
#include "base/predicates.hpp"
#include "base/random.hpp"
#include "geometry/edit/faces_at_vertices.hpp"
#include "geometry/inspect/place_keys.hpp"
#include "geometry/intersect/self_intersections.hpp"

#include <algorithm>
#include <array>

namespace facetmill {

namespace {

/// The corner before c in its face.
Index previous_corner(const Mesh& mesh, Index f, Index c) {
    return c == mesh.face_begin(f) ? mesh.face_end(f) - 1 : c - 1;
}

/// Directions of the faces along an edge: how many run from low to high and how many back.
std::array<int, 2> directions(const Mesh& mesh, const EdgeTable& edges, Index e) {
    std::array<int, 2> ways{};
    for (const Index c : edges.corners_of(e)) ++ways[mesh.vertex(c) == edges.edges[e].low ? 0 : 1];
    return ways;
}

template <class Fails>
std::vector<Place> places_of_edges(const Mesh& mesh, std::size_t limit, Fails fails) {
    const EdgeTable edges = build_edges(mesh);
    const auto faces = corner_faces(mesh);
    std::vector<Place> places;
    for (Index e = 0; e < edges.size() && places.size() < limit; ++e) {
        if (!fails(directions(mesh, edges, e))) continue;
        const Vec3 &low = mesh.positions[edges.edges[e].low], &high = mesh.positions[edges.edges[e].high];
        places.push_back({.face = faces[edges.corners_of(e).front()],
                          .at = mix(low, high, 0.5),
                          .key = key_of_edge(low, high)});
    }
    return places;
}

std::vector<Place> places_of_vertices(const Mesh& mesh, std::size_t limit, bool isolated) {
    const auto fans = fans_at_vertices(mesh, build_edges(mesh));
    const auto faces = faces_at_vertices(mesh);
    std::vector<Place> places;
    for (Index v = 0; v < fans.size() && places.size() < limit; ++v)
        if (isolated ? fans[v] == 0 : fans[v] > 1)
            places.push_back(
                {.face = faces[v], .at = mesh.positions[v], .key = key_of_point(mesh.positions[v])});
    return places;
}

std::vector<Place> places_of_faces(const Mesh& mesh, const std::vector<Index>& faces) {
    std::vector<Place> places;
    for (const Index f : faces) places.push_back(place_of(mesh, f));
    return places;
}

std::vector<Index> degenerate_faces(const Mesh& mesh, std::size_t limit) {
    std::vector<Index> found;
    for (Index f = 0; f < mesh.face_count() && found.size() < limit; ++f)
        if (is_degenerate(mesh, f)) found.push_back(f);
    return found;
}

/// The first face of each piece.
std::vector<Place> places_of_pieces(const Mesh& mesh, std::size_t limit) {
    const Components pieces = face_components(mesh);
    const auto keys = keys_of_pieces(mesh, pieces.of_face, pieces.count);
    std::vector<Place> found;
    for (Index f = 0; f < mesh.face_count() && found.size() < limit; ++f)
        if (pieces.of_face[f] == found.size()) { // pieces are numbered by first face
            found.push_back(place_of(mesh, f));
            found.back().key = keys[found.size() - 1];
        }
    return found;
}

/// The set of vertices of a face, sorted.
void vertex_set(const Mesh& mesh, Index f, std::vector<Index>& set) {
    set.clear();
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) set.push_back(mesh.vertex(c));
    std::sort(set.begin(), set.end());
    set.erase(std::unique(set.begin(), set.end()), set.end());
}

struct HashedFace {
    std::uint64_t hash;
    Index face;
};

/// All faces by a hash of their sets of vertices, equal hashes together and by face.
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
    constexpr std::size_t few = 2048; // a radix sort of fewer counts more buckets than faces
    if (faces.size() <= few)
        std::sort(faces.begin(), faces.end(), [](const HashedFace& a, const HashedFace& b) {
            return a.hash != b.hash ? a.hash < b.hash : a.face < b.face;
        });
    else
        radix_sort(faces, [](const HashedFace& f) { return f.hash; });
    return faces;
}

/// Whether two faces have the same set of vertices: for faces whose hashes agree.
bool same_set(const Mesh& mesh, Index a, Index b) {
    std::vector<Index> set_a, set_b;
    vertex_set(mesh, a, set_a), vertex_set(mesh, b, set_b);
    return set_a == set_b;
}

/// True when the cross product of u and w is sure not to vanish, by the filter of orientation_2d.
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
    // With the first corner and the first that differs from it, every other corner must be on one line.
    const Vec3& p = mesh.point(begin);
    Index other = begin + 1;
    while (other < end && mesh.point(other) == p) ++other;
    if (other + 1 >= end) return true;
    const Vec3& q = mesh.point(other);
    for (Index c = other + 1; c < end; ++c)
        if (!is_degenerate(p, q, mesh.point(c))) return false;
    return true;
}

Place place_of(const Mesh& mesh, Index f) {
    Vec3 sum;
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) sum += mesh.point(c);
    return {.face = f, .at = sum / mesh.face_size(f), .key = key_of_face(mesh, f)};
}

std::vector<Place> places_of_pairs(const Mesh& mesh, const std::vector<std::pair<Index, Index>>& pairs,
                                   std::size_t limit) {
    std::vector<Place> places;
    for (const auto& [f, g] : pairs) {
        if (places.size() == limit) break;
        places.push_back(place_of(mesh, f));
        places.back().with = g;
        places.back().key = key_of_pair(mesh, f, g);
    }
    return places;
}

std::vector<Index> fans_at_vertices(const Mesh& mesh, const EdgeTable& edges) {
    const VertexLists lists = corners_at_vertices(mesh);
    const auto faces = corner_faces(mesh);
    std::vector<Index> fans(mesh.vertex_count());
    parallel_chunks(mesh.vertex_count(), [&](std::size_t begin, std::size_t end) {
        std::vector<std::pair<Index, Index>> ends; // (edge, place of the corner in the vertex's list)
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
                if (a != b) parent[std::max(a, b)] = std::min(a, b), --count;
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
             ++i) // by chance a hash may be shared by different sets: all are compared
            for (std::size_t j = begin; j < i; ++j)
                if (same_set(mesh, faces[i].face, faces[j].face)) {
                    duplicates.push_back(faces[i].face);
                    break;
                }
    }
    std::sort(duplicates.begin(), duplicates.end());
    return duplicates;
}

std::vector<Place> places_against(const Mesh& mesh, std::string_view property, std::size_t limit) {
    using Ways = std::array<int, 2>;
    if (property == "closed" || property == "boundary_edges" || property == "boundary_loops" ||
        property == "volume" || property == "genus")
        return places_of_edges(mesh, limit, [](const Ways& w) { return w[0] != w[1]; });
    if (property == "edge_manifold")
        return places_of_edges(mesh, limit, [](const Ways& w) { return w[0] + w[1] > 2; });
    if (property == "oriented")
        return places_of_edges(mesh, limit, [](const Ways& w) { return std::abs(w[0] - w[1]) > 1; });
    if (property == "euler") { // what is not open, and no handle
        auto places = places_against(mesh, "edge_manifold", limit);
        const auto more = places_against(mesh, "vertex_manifold", limit - places.size());
        places.insert(places.end(), more.begin(), more.end());
        return places;
    }
    if (property == "components") return places_of_pieces(mesh, limit);
    if (property == "vertex_manifold") return places_of_vertices(mesh, limit, false);
    if (property == "isolated_vertices") return places_of_vertices(mesh, limit, true);
    if (property == "degenerate_faces") return places_of_faces(mesh, degenerate_faces(mesh, limit));
    if (property == "duplicate_faces") {
        auto faces = duplicate_faces(mesh);
        faces.resize(std::min(faces.size(), limit));
        return places_of_faces(mesh, faces);
    }
    if (property == "self_intersections" || property == "touching") {
        const auto found = find_self_intersections(mesh, {.limit = limit, .apart = true});
        return places_of_pairs(mesh, property == "touching" ? found.touching_pairs : found.pairs, limit);
    }
    return {};
}

} // namespace facetmill
