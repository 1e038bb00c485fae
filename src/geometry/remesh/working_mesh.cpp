#include "geometry/remesh/working_mesh.hpp"

namespace facetmill::remeshing {

bool WorkingMesh::are_joined(Index v, Index w) const {
    if (kinds[v] == VertexKind::many) std::swap(v, w);
    bool found = false;
    neighbours(v, [&](Index n) { found = found || n == w; });
    return found;
}

Index WorkingMesh::add_face(const std::array<Index, 3>& vertices, Index region) {
    const auto f = static_cast<Index>(face_slots());
    corners.insert(corners.end(), vertices.begin(), vertices.end());
    twins.insert(twins.end(), 3, none);
    rings.insert(rings.end(), 3, none);
    flags.insert(flags.end(), 3, std::uint8_t{0});
    regions.push_back(region);
    return f;
}

Index WorkingMesh::add_vertex(const Vec3& point, double size, Index hint, VertexKind kind) {
    points.push_back(point);
    sizes.push_back(size);
    hints.push_back(hint);
    kinds.push_back(kind);
    degrees.push_back(0);
    out.push_back(none);
    return static_cast<Index>(points.size() - 1);
}

// Face (a, b, c) with the side from a to b becomes (a, m, c) and (m, b, c).
Index WorkingMesh::halve(Index side, Index m) {
    const Index c = opposite(side), end = to(side), across = next(side);
    const Index added = 3 * add_face({m, end, c}, regions[side / 3]);
    join(added + 1, twins[across]);
    flags[added + 1] = flags[across];
    flags[added] = flags[side];
    if (rings[across] != none) { // the far edge is locked and now belongs to the new face
        Index last = across;
        while (rings[last] != across) last = rings[last];
        rings[last] = added + 1;
        rings[added + 1] = rings[across] == across ? added + 1 : rings[across];
        rings[across] = none;
    }
    twins[across] = none;
    corners[across] = m;
    flags[across] = 0;
    join(across, added + 2);
    if (out[end] == across) out[end] = added + 1;
    ++degrees[c];
    return added;
}

Index WorkingMesh::split(Index h, const Vec3& point, double size, Index hint) {
    const Index twin = twins[h];
    const Index m = add_vertex(point, size, hint, flags[h] & feature ? VertexKind::line : VertexKind::free);
    const Index first = halve(h, m);
    out[m] = first;
    degrees[m] = twin == none ? 3 : 4;
    if (twin == none) return m;
    const Index second = halve(twin, m);
    // h runs to m, and `second` from m to the start of h.
    join(h, second);
    join(twin, first);
    return m;
}

bool WorkingMesh::leads_ring(Index h) const {
    for (Index side = rings[h]; side != h; side = rings[side])
        if (side < h) return false;
    return true;
}

void WorkingMesh::split_locked(Index h, const Vec3& point, double size, Index hint) {
    const Index a = from(h), m = add_vertex(point, size, hint, VertexKind::many);
    std::vector<Index> sides{h};
    for (Index side = rings[h]; side != h; side = rings[side]) sides.push_back(side);
    std::vector<Index> near_a, near_b; // the sides of the two new edges
    for (const Index side : sides) {
        const bool from_a = from(side) == a;
        const Index added = halve(side, m);
        near_a.push_back(from_a ? side : added);
        near_b.push_back(from_a ? added : side);
    }
    for (const auto* ring : {&near_a, &near_b})
        for (std::size_t i = 0; i < ring->size(); ++i) rings[(*ring)[i]] = (*ring)[(i + 1) % ring->size()];
    degrees[m] = static_cast<Index>(2 + sides.size());
    out[m] = near_b.front();
}

/// Joins the neighbours of a face across its two edges that fall together. a, b: half edges of the face.
void WorkingMesh::close_gap(Index f, Index a, Index b) {
    const Index across_a = twins[a], across_b = twins[b];
    const std::uint8_t both = flags[a] | flags[b];
    for (const Index h : {across_a, across_b})
        if (h != none) flags[h] = both;
    if (across_a != none)
        join(across_a, across_b);
    else if (across_b != none)
        join(across_b, none);
    for (Index k = 0; k < 3; ++k) corners[3 * f + k] = none;
}

void WorkingMesh::collapse(Index h) {
    const Index a = from(h), b = to(h), twin = twins[h];
    const std::array<Index, 2> third{opposite(h), twin == none ? none : opposite(twin)};
    around(a, [&](Index leaving) { // the faces of a keep their half edges
        corners[leaving] = b;
        return true;
    });
    Index keeps_b = none;
    std::array<Index, 2> keeps{none, none};
    for (std::size_t k = 0; k < 2; ++k) {
        const Index side = k == 0 ? h : twin;
        if (side == none) continue;
        const Index x = next(side), y = previous(side);
        const Index over_x = twins[x], over_y = twins[y];
        // In the faces that stay, over_x leaves the third vertex, and over_y leaves b.
        keeps[k] = over_x != none ? over_x : next(over_y);
        keeps_b = over_y != none ? over_y : next(over_x);
        close_gap(side / 3, x, y);
    }
    for (std::size_t k = 0; k < 2; ++k)
        if (third[k] != none) {
            --degrees[third[k]];
            if (kinds[third[k]] != VertexKind::many) out[third[k]] = keeps[k];
        }
    out[b] = keeps_b;
    const Index both = twin == none ? 1 : 2;
    degrees[b] += degrees[a] - 2 - both;
    out[a] = none;
}

// The edge from a to b of (a, b, c) and (b, a, d) becomes the edge from d to c of (a, d, c) and (b, c, d).
void WorkingMesh::flip(Index h) {
    const Index twin = twins[h];
    const Index a = from(h), b = to(h), c = opposite(h), d = opposite(twin);
    const Index bc = next(h), ca = previous(h), ad = next(twin), db = previous(twin);
    const Index over_bc = twins[bc], over_ca = twins[ca], over_ad = twins[ad], over_db = twins[db];
    const std::uint8_t flag_bc = flags[bc], flag_ca = flags[ca], flag_ad = flags[ad], flag_db = flags[db];
    // h's face: d to c, c to a, a to d. twin's face: c to d, d to b, b to c.
    corners[h] = d;
    corners[bc] = c;
    corners[ca] = a;
    corners[twin] = c;
    corners[ad] = d;
    corners[db] = b;
    join(bc, over_ca);
    flags[bc] = flag_ca;
    join(ca, over_ad);
    flags[ca] = flag_ad;
    join(ad, over_db);
    flags[ad] = flag_db;
    join(db, over_bc);
    flags[db] = flag_bc;
    const auto leaves = [&](Index v, Index half_edge) {
        if (kinds[v] != VertexKind::many) out[v] = half_edge;
    };
    leaves(a, ca);
    leaves(b, db);
    leaves(c, bc);
    leaves(d, ad);
    --degrees[a];
    --degrees[b];
    ++degrees[c];
    ++degrees[d];
}

void WorkingMesh::compact() {
    std::vector<Index> vertex_now(points.size(), none), face_now(face_slots(), none);
    Index vertices = 0, faces = 0;
    for (Index h = 0; h < corners.size(); ++h) // collapses and flips do not change `out` of such a vertex
        if (corners[h] != none && kinds[corners[h]] == VertexKind::many) out[corners[h]] = h;
    for (Index v = 0; v < points.size(); ++v) {
        if (out[v] == none) continue;
        points[vertices] = points[v];
        sizes[vertices] = sizes[v];
        kinds[vertices] = kinds[v];
        hints[vertices] = hints[v];
        degrees[vertices] = degrees[v];
        out[vertices] = out[v];
        vertex_now[v] = vertices++;
    }
    for (Index f = 0; f < face_slots(); ++f)
        if (is_face(f)) face_now[f] = faces++;
    const auto half_edge_now = [&](Index h) { return h == none ? none : 3 * face_now[h / 3] + h % 3; };
    for (Index f = 0; f < face_now.size(); ++f) {
        const Index now = face_now[f];
        if (now == none) continue;
        for (Index k = 0; k < 3; ++k) {
            corners[3 * now + k] = vertex_now[corners[3 * f + k]];
            twins[3 * now + k] = half_edge_now(twins[3 * f + k]);
            rings[3 * now + k] = half_edge_now(rings[3 * f + k]);
            flags[3 * now + k] = flags[3 * f + k];
        }
        regions[now] = regions[f];
    }
    for (Index v = 0; v < vertices; ++v) out[v] = half_edge_now(out[v]);
    points.resize(vertices);
    sizes.resize(vertices);
    kinds.resize(vertices);
    hints.resize(vertices);
    degrees.resize(vertices);
    out.resize(vertices);
    corners.resize(3 * std::size_t{faces});
    twins.resize(3 * std::size_t{faces});
    rings.resize(3 * std::size_t{faces});
    flags.resize(3 * std::size_t{faces});
    regions.resize(faces);
}

} // namespace facetmill::remeshing
