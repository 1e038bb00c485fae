// Open borders that run along each other, as of patches and parts that were never welded: for the work their
// vertices are joined and the wedges stay apart, so that both sides collapse as the two sides of a seam do.

#include "geometry/simplify/coincident.hpp"

#include "base/parallel.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace facetmill::simplification {

namespace {

/// An open edge by the places of its ends, the lower first.
struct OpenEdge {
    Index low, high; ///< places, numbered
    Index from, to;  ///< the vertices there
    bool along(const OpenEdge& o) const { return low == o.low && high == o.high; }
};

/// The vertices of the mesh at both ends of every open edge of finite length.
std::vector<std::array<Index, 2>> open_edges(const Work& s, const Mesh& mesh) {
    std::vector<std::array<Index, 2>> ends;
    for (Index c = 0; c < s.flags.size(); ++c) {
        if (!(s.flags[c] & boundary_edge)) continue;
        const Index u = s.source[s.tri[c]], v = s.source[s.tri[after(c)]];
        if (is_finite(mesh.positions[u]) && is_finite(mesh.positions[v])) ends.push_back({u, v});
    }
    return ends;
}

/// Open edges by place; what lies in one place is side by side.
std::vector<OpenEdge> by_place(const Work& s, const Mesh& mesh) {
    const auto ends = open_edges(s, mesh);
    const auto less = [&](Index a, Index b) {
        const Vec3 &p = mesh.positions[a], &q = mesh.positions[b];
        return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
    };
    std::vector<Index> order;
    for (const auto& [u, v] : ends) order.push_back(u), order.push_back(v);
    std::sort(order.begin(), order.end(), less);
    const auto place = [&](Index v) {
        return static_cast<Index>(std::lower_bound(order.begin(), order.end(), v, less) - order.begin());
    };
    std::vector<OpenEdge> edges;
    for (auto [u, v] : ends) {
        Index low = place(u), high = place(v);
        if (low > high) std::swap(low, high), std::swap(u, v);
        if (low != high) edges.push_back({low, high, u, v});
    }
    std::sort(edges.begin(), edges.end(), [](const OpenEdge& a, const OpenEdge& b) {
        return std::tie(a.low, a.high, a.from, a.to) < std::tie(b.low, b.high, b.from, b.to);
    });
    return edges;
}

/// Calls body for each two edges in one place.
template <class Body>
void for_pairs(const std::vector<OpenEdge>& edges, Body&& body) {
    for (std::size_t i = 1; i < edges.size(); ++i)
        if (edges[i].along(edges[i - 1])) body(edges[i - 1], edges[i]);
}

} // namespace

std::vector<Index> touching_vertices(const Work& s, const Mesh& mesh) {
    const std::vector<OpenEdge> edges = by_place(s, mesh);
    bool any = false;
    for_pairs(edges, [&](const OpenEdge&, const OpenEdge&) { any = true; });
    if (!any) return {};
    DisjointSets joined(mesh.vertex_count());
    for_pairs(edges, [&](const OpenEdge& a, const OpenEdge& b) {
        joined.join(a.from, b.from), joined.join(a.to, b.to);
    });
    std::vector<Index> target(mesh.vertex_count());
    for (Index v = 0; v < target.size(); ++v) target[v] = joined.find(v);
    return target;
}

void Touching::join(Mesh& mesh, const std::vector<Index>& target) {
    plain_ = !mesh.has_seams();
    sides_.resize(mesh.wedge_count());
    for (Index w = 0; w < sides_.size(); ++w) sides_[w] = mesh.vertex_of_wedge(w);
    mesh.wedge_vertex.resize(sides_.size());
    for (std::size_t w = 0; w < sides_.size(); ++w) mesh.wedge_vertex[w] = target[sides_[w]];
    for (Attribute& a : mesh.attributes) {
        if (a.domain != Domain::vertex) continue;
        a.select(sides_);
        a.domain = Domain::wedge;
        of_vertices_.push_back(a.name);
    }
}

void Touching::part(Mesh& mesh, const std::vector<Index>& wedges, Fates& fates) const {
    std::vector<Index> first(mesh.vertex_count(), none);
    std::vector<Index> wedge_of(mesh.vertex_count(), none); // one at each vertex
    std::map<std::pair<Index, Index>, Index> others;        // by vertex and side
    for (Index w = 0; w < wedges.size(); ++w) {
        Index& v = mesh.wedge_vertex[w];
        const Index side = sides_[wedges[w]];
        if (first[v] == none) first[v] = side;
        if (first[v] != side) {
            const auto [at, fresh] = others.try_emplace({v, side}, static_cast<Index>(mesh.positions.size()));
            if (fresh) mesh.positions.push_back(Vec3(mesh.positions[v])), wedge_of.push_back(none);
            v = at->second;
        }
        wedge_of[v] = w;
    }
    if (plain_) { // every wedge is a vertex again
        std::vector<Vec3> positions(wedges.size());
        for (std::size_t w = 0; w < wedges.size(); ++w) positions[w] = mesh.positions[mesh.wedge_vertex[w]];
        mesh.positions = std::move(positions);
        mesh.wedge_vertex = {};
        for (Index w = 0; w < wedges.size(); ++w) wedge_of[w] = w;
    }
    for (const std::string& name : of_vertices_) {
        Attribute& a = *mesh.find(name, Domain::wedge);
        a.select(wedge_of);
        a.domain = Domain::vertex;
        for (Fate& fate : fates)
            if (fate.attribute == name && fate.domain == Domain::wedge) fate.domain = Domain::vertex;
    }
}

std::size_t Touching::doubled(const Work& s) const {
    std::set<std::pair<Index, Index>> seen;
    std::vector<Index> first(s.vertex_slots(), none);
    for (std::size_t c = 0; c < s.tri.size(); ++c) {
        if (!s.live(static_cast<Index>(c / 3))) continue;
        Index& side = first[s.tri[c]];
        if (side == none) side = sides_[s.wedge[c]];
        if (side != sides_[s.wedge[c]]) seen.insert({s.tri[c], sides_[s.wedge[c]]});
    }
    return seen.size();
}

} // namespace facetmill::simplification
