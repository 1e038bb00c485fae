#include "io/wedges.hpp"

#include <map>
#include <numeric>
#include <utility>

namespace facetmill::io {

Wedges make_wedges(std::size_t vertices, std::vector<Index> corner_vertex,
                   std::span<const std::uint64_t> corner_key) {
    Wedges w;
    w.keys.assign(vertices, no_key);
    std::vector<bool> used(vertices, false);
    std::vector<Index> next(vertices, none), extra_vertex;
    // Wedges of a vertex are a short list. A hostile file may have millions at one; those are looked up.
    constexpr int longest_walk = 64;
    std::map<std::pair<Index, std::uint64_t>, Index> crowded;
    for (std::size_t c = 0; c < corner_vertex.size(); ++c) {
        const Index v = corner_vertex[c];
        if (!used[v]) {
            used[v] = true;
            w.keys[v] = corner_key[c];
            continue;
        }
        Index wedge = v;
        int steps = 0;
        while (w.keys[wedge] != corner_key[c] && next[wedge] != none && ++steps < longest_walk)
            wedge = next[wedge];
        if (w.keys[wedge] != corner_key[c]) {
            const auto fresh = static_cast<Index>(w.keys.size());
            Index& slot = steps < longest_walk ? next[wedge]
                                               : crowded.try_emplace({v, corner_key[c]}, none).first->second;
            if (slot == none) {
                slot = fresh;
                w.keys.push_back(corner_key[c]);
                next.push_back(none);
                extra_vertex.push_back(v);
            }
            wedge = w.keys.size() > fresh ? fresh : crowded.at({v, corner_key[c]});
        }
        corner_vertex[c] = wedge;
    }
    w.corners = std::move(corner_vertex);
    if (extra_vertex.empty()) return w;
    w.wedge_vertex.resize(vertices);
    std::iota(w.wedge_vertex.begin(), w.wedge_vertex.end(), Index{0});
    w.wedge_vertex.insert(w.wedge_vertex.end(), extra_vertex.begin(), extra_vertex.end());
    return w;
}

} // namespace facetmill::io
