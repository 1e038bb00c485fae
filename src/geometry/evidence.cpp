#include "geometry/evidence.hpp"

#include "base/parallel.hpp"
#include "base/predicates.hpp"

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
        const auto& [low, high] = edges.edges[e];
        places.push_back(
            {faces[edges.corners_of(e).front()], mix(mesh.positions[low], mesh.positions[high], 0.5)});
    }
    return places;
}

std::vector<Place> places_of_vertices(const Mesh& mesh, std::size_t limit, bool isolated) {
    const auto fans = fans_at_vertices(mesh, build_edges(mesh));
    std::vector<Place> places;
    for (Index v = 0; v < fans.size() && places.size() < limit; ++v)
        if (isolated ? fans[v] == 0 : fans[v] > 1) places.push_back({none, mesh.positions[v]});
    return places;
}

std::vector<Place> places_of_faces(const Mesh& mesh, const std::vector<Index>& faces) {
    std::vector<Place> places;
    for (const Index f : faces) {
        Vec3 sum;
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) sum += mesh.point(c);
        places.push_back({f, sum / mesh.face_size(f)});
    }
    return places;
}

std::vector<Index> degenerate_faces(const Mesh& mesh, std::size_t limit) {
    std::vector<Index> found;
    for (Index f = 0; f < mesh.face_count() && found.size() < limit; ++f)
        if (is_degenerate(mesh, f)) found.push_back(f);
    return found;
}

std::vector<Index> sorted_vertices(const Mesh& mesh, Index f) {
    std::vector<Index> all;
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) all.push_back(mesh.vertex(c));
    std::sort(all.begin(), all.end());
    return all;
}

} // namespace

bool is_degenerate(const Mesh& mesh, Index f) {
    const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
    for (Index a = begin; a + 2 < end; ++a)
        for (Index b = a + 1; b + 1 < end; ++b) {
            if (mesh.point(a) == mesh.point(b)) continue;
            // a and b span a line: is there a corner off it?
            for (Index c = b + 1; c < end; ++c)
                if (!collinear(mesh.point(a), mesh.point(b), mesh.point(c))) return false;
            break;
        }
    return true;
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

std::vector<Index> duplicate_faces(const Mesh& mesh, const EdgeTable& edges) {
    // Duplicates share all their edges: compare faces only with those whose lowest edge is the same.
    const auto faces = corner_faces(mesh);
    const auto lowest = [&](Index f) {
        Index low = none;
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            low = std::min(low, edges.corner_edge[c]);
        return low;
    };
    using List = std::vector<Index>;
    auto found = parallel_reduce(
        edges.size(), List{},
        [&](std::size_t begin, std::size_t end) {
            List mine;
            std::vector<std::pair<List, Index>> here;
            for (std::size_t e = begin; e < end; ++e) {
                const auto corners = edges.corners_of(static_cast<Index>(e));
                if (corners.size() < 2) continue;
                here.clear();
                Index last = none;
                for (const Index c : corners) {
                    const Index f = faces[c];
                    if (f != last && lowest(f) == e) here.emplace_back(sorted_vertices(mesh, f), f);
                    last = f;
                }
                if (here.size() < 2) continue;
                std::sort(here.begin(), here.end());
                for (std::size_t i = 1; i < here.size(); ++i)
                    if (here[i].first == here[i - 1].first && here[i].second != here[i - 1].second)
                        mine.push_back(here[i].second);
            }
            return mine;
        },
        [](List a, List b) { return a.insert(a.end(), b.begin(), b.end()), a; });
    std::sort(found.begin(), found.end());
    return found;
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
    if (property == "vertex_manifold") return places_of_vertices(mesh, limit, false);
    if (property == "isolated_vertices") return places_of_vertices(mesh, limit, true);
    if (property == "degenerate_faces") return places_of_faces(mesh, degenerate_faces(mesh, limit));
    if (property == "duplicate_faces") {
        auto faces = duplicate_faces(mesh, build_edges(mesh));
        faces.resize(std::min(faces.size(), limit));
        return places_of_faces(mesh, faces);
    }
    return {};
}

} // namespace facetmill
