#include "cells/sources/unite.hpp"

#include <numeric>

namespace facetmill::cells {

namespace {

/// Compares vertices: negative, zero or positive, like a difference.
int compare_vertices(const Mesh& mesh, const std::vector<std::uint64_t>& names, Index a, Index b) {
    if (names[a] != names[b]) return names[a] < names[b] ? -1 : 1;
    const Vec3 &p = mesh.positions[a], &q = mesh.positions[b];
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (p[axis] != q[axis]) return p[axis] < q[axis] ? -1 : 1;
    return 0;
}

} // namespace

std::vector<Index> unite(Mesh& mesh, std::vector<std::uint64_t>& names, std::vector<Index> some) {
    std::sort(some.begin(), some.end(), [&](Index a, Index b) {
        const int order = compare_vertices(mesh, names, a, b);
        return order != 0 ? order < 0 : a < b;
    });
    std::vector<Index> first(mesh.vertex_count());
    std::iota(first.begin(), first.end(), Index{0});
    for (std::size_t i = 1; i < some.size(); ++i)
        if (compare_vertices(mesh, names, some[i - 1], some[i]) == 0) first[some[i]] = first[some[i - 1]];
    std::vector<Index> kept, number(first.size(), none);
    for (Index v = 0; v < first.size(); ++v) {
        if (first[v] != v) continue;
        number[v] = static_cast<Index>(kept.size());
        mesh.positions[kept.size()] = mesh.positions[v];
        names[kept.size()] = names[v];
        kept.push_back(v);
    }
    for (Index& corner : mesh.corners) corner = number[first[corner]];
    mesh.positions.resize(kept.size());
    names.resize(kept.size());
    for (Attribute& a : mesh.attributes)
        if (a.domain != Domain::face) a.select(kept);
    return kept;
}

} // namespace facetmill::cells
