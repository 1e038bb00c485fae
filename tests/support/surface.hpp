#pragma once
// Properties of a surface that tests need, counted in the plainest way.

#include "parallel/parallel.hpp"
#include "support/measure.hpp"

#include <map>
#include <set>

namespace facetmill::test {

struct Counts {
    std::int64_t euler = 0;
    std::size_t open = 0;       ///< edges with one face
    std::size_t crowded = 0;    ///< edges with more than two faces
    std::size_t unbalanced = 0; ///< edges whose two directions do not cancel
    std::size_t duplicates = 0; ///< faces with the same vertices as an earlier face
    std::size_t pinched = 0;    ///< vertices whose faces form more than one fan
    std::size_t flat = 0;       ///< triangles without area
    bool operator==(const Counts&) const = default;
};

inline Counts count(const Mesh& m) {
    std::map<std::pair<Index, Index>, std::pair<std::size_t, int>> edges; // face count, and sum of directions
    std::map<Index, std::vector<std::pair<Index, Index>>> links;
    std::set<std::set<Index>> faces;
    Counts counts;
    for (Index f = 0; f < m.face_count(); ++f) {
        const Index begin = m.face_begin(f), n = m.face_size(f);
        std::set<Index> face;
        for (Index k = 0; k < n; ++k) {
            const Index a = m.vertex(begin + k), b = m.vertex(begin + (k + 1) % n),
                        z = m.vertex(begin + (k + n - 1) % n);
            face.insert(a);
            auto& e = edges[{std::min(a, b), std::max(a, b)}];
            ++e.first;
            e.second += a < b ? 1 : -1;
            links[a].emplace_back(z, b);
        }
        counts.duplicates += !faces.insert(face).second;
        if (n == 3)
            counts.flat +=
                length(cross(m.point(begin + 1) - m.point(begin), m.point(begin + 2) - m.point(begin))) == 0;
    }
    for (const auto& [e, c] : edges) {
        counts.open += c.first == 1;
        counts.crowded += c.first > 2;
        counts.unbalanced += c.second != 0;
    }
    for (auto& [v, link] :
         links) { // merge the link's edges until no two can be joined; the remaining chains are the fans
        std::map<Index, Index> root;
        const auto find = [&](Index x) {
            while (root[x] != x) x = root[x];
            return x;
        };
        for (const auto& [a, b] : link) {
            root.emplace(a, a);
            root.emplace(b, b);
        }
        for (const auto& [a, b] : link) root[find(a)] = find(b);
        std::set<Index> fans;
        for (const auto& [x, _] : root) fans.insert(find(x));
        counts.pinched += fans.size() > 1;
    }
    counts.euler = static_cast<std::int64_t>(links.size()) - static_cast<std::int64_t>(edges.size()) +
                   static_cast<std::int64_t>(m.face_count());
    return counts;
}

/// Whether the mesh is closed and manifold, has that Euler number, and no duplicate or flat faces.
inline bool sound(const Mesh& m, std::int64_t euler) { return count(m) == Counts{euler}; }

/// Whether all arrays are equal by ==.
inline bool same(const Mesh& a, const Mesh& b) {
    if (a.attributes.size() != b.attributes.size()) return false;
    for (std::size_t i = 0; i < a.attributes.size(); ++i)
        if (a.attributes[i].name != b.attributes[i].name || a.attributes[i].data != b.attributes[i].data)
            return false;
    return a.positions == b.positions && a.corners == b.corners && a.wedge_vertex == b.wedge_vertex &&
           a.face_offsets == b.face_offsets && a.primitives == b.primitives;
}

/// Whether make() gives the same mesh with one, two and three threads.
template <class Make>
bool same_for_any_threads(Make&& make) {
    set_threads(1);
    const Mesh one = make();
    set_threads(2);
    const Mesh two = make();
    set_threads(3);
    const Mesh three = make();
    set_threads(0);
    return same(one, two) && same(one, three);
}

/// Adds a wedge attribute with the vertex coordinates, to compare interpolated values with positions.
inline void add_coordinates(Mesh& m) {
    Attribute a;
    a.name = "coordinates";
    a.components = 3;
    std::vector<double> data;
    for (Index w = 0; w < m.wedge_count(); ++w)
        for (std::size_t i = 0; i < 3; ++i) data.push_back(m.positions[m.vertex_of_wedge(w)][i]);
    a.data = std::move(data);
    m.attributes.push_back(std::move(a));
}

} // namespace facetmill::test
