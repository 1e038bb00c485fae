#include "geometry/clip/cap_section.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace facetmill {

Index CutSection::number(Index low, Index high) const {
    const auto it = std::lower_bound(edges.begin(), edges.end(), std::pair{low, high},
                                     [](const Edge& e, const auto& key) {
                                         return e.low != key.first ? e.low < key.first : e.high < key.second;
                                     });
    return it != edges.end() && it->low == low && it->high == high ? static_cast<Index>(it - edges.begin())
                                                                   : none;
}

CutSection find_section(const PlaneCut& cut, int side, const Pieces& pieces) {
    std::vector<CutSection::Edge> uses;
    const auto collect = [&](std::span<const Index> polygon) {
        for_polygon_edges(polygon, [&](Index a, Index b) {
            if (cut.sign_of(a) != 0 || cut.sign_of(b) != 0) return;
            const Index va = cut.vertex_of(a), vb = cut.vertex_of(b);
            if (va < vb) uses.push_back({va, vb, a, b, 1});
            if (vb < va) uses.push_back({vb, va, b, a, -1});
        });
    };
    for (std::size_t i = 0; i < pieces.size(); ++i) collect(pieces.of(i));
    for (const auto* list : {&cut.touching, &cut.flat})
        for (const Index f : *list)
            if (cut.stays(f, side)) collect(cut.mesh->face_wedges(f));
    const int bits = static_cast<int>(std::bit_width(cut.first_extra_vertex()));
    radix_sort(
        uses, [&](const CutSection::Edge& e) { return static_cast<std::uint64_t>(e.low) << bits | e.high; },
        2 * bits);
    CutSection section;
    for (std::size_t i = 0; i < uses.size();) {
        CutSection::Edge sum = uses[i++];
        while (i < uses.size() && uses[i].low == sum.low && uses[i].high == sum.high)
            sum.count += uses[i++].count;
        if (sum.count != 0) section.edges.push_back(sum);
    }
    return section;
}

namespace {

/// Union-find over the vertices of a section, with the number of edges that leave minus those that arrive.
struct SectionGraph {
    std::vector<Index> vertices, root;
    std::vector<long long> balance;

    explicit SectionGraph(const CutSection& section) {
        for (const auto& e : section.edges) {
            vertices.push_back(e.low);
            vertices.push_back(e.high);
        }
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        root.resize(vertices.size());
        std::iota(root.begin(), root.end(), Index{0});
        balance.resize(vertices.size());
        for (const auto& e : section.edges) {
            const Index a = local(e.low), b = local(e.high);
            balance[a] += e.count;
            balance[b] -= e.count;
            const Index ra = find(a), rb = find(b);
            root[std::max(ra, rb)] = std::min(ra, rb);
        }
    }
    Index local(Index v) const {
        return static_cast<Index>(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin());
    }
    Index find(Index i) {
        while (root[i] != i) i = root[i] = root[root[i]];
        return i;
    }
};

} // namespace

std::vector<OpenEnd> drop_open_contours(CutSection& section, const PlaneCut& cut) {
    SectionGraph graph(section);
    std::vector<Index> number(graph.vertices.size(), none); // of the open contour with that root
    std::vector<OpenEnd> open;
    for (Index i = 0; i < graph.vertices.size(); ++i) {
        if (graph.balance[i] == 0 || number[graph.find(i)] != none) continue;
        number[graph.find(i)] = static_cast<Index>(open.size());
        open.push_back({0, cut.point(graph.vertices[i])});
    }
    if (open.empty()) return open;
    std::erase_if(section.edges, [&](const CutSection::Edge& e) {
        const Index n = number[graph.find(graph.local(e.low))];
        if (n != none) ++open[n].edges;
        return n != none;
    });
    return open;
}

} // namespace facetmill
