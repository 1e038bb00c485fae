#include "geometry/edit/equal_wedges.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>
#include <cstring>
#include <span>

namespace facetmill {

namespace {

/// Compares wedges by the bits of all their attributes.
class WedgeBits {
  public:
    explicit WedgeBits(const Mesh& mesh) {
        for (const auto& a : mesh.attributes)
            if (a.domain == Domain::wedge)
                std::visit(
                    [&](const auto& v) {
                        columns_.push_back({reinterpret_cast<const std::byte*>(v.data()),
                                            static_cast<std::size_t>(a.components) * sizeof(v[0])});
                    },
                    a.data);
    }
    int compare(Index a, Index b) const {
        for (const auto& c : columns_)
            if (const int order = std::memcmp(c.data + a * c.width, c.data + b * c.width, c.width))
                return order;
        return 0;
    }

  private:
    struct Column {
        const std::byte* data;
        std::size_t width;
    };
    std::vector<Column> columns_;
};

/// The wedges of each vertex, ascending.
struct Groups {
    std::vector<Index> offsets, wedges;
};
Groups wedges_of_vertices(const Mesh& mesh) {
    Groups g;
    g.offsets.assign(mesh.vertex_count() + 1, 0);
    for (const Index v : mesh.wedge_vertex) ++g.offsets[v];
    exclusive_scan(g.offsets);
    g.wedges.resize(mesh.wedge_count());
    auto next = g.offsets;
    for (Index w = 0; w < mesh.wedge_count(); ++w) g.wedges[next[mesh.wedge_vertex[w]]++] = w;
    return g;
}

/// For each of a vertex's wedges (ascending), finds the first equal wedge.
void find_representatives(std::span<const Index> wedges, const WedgeBits& bits, std::vector<Index>& different,
                          std::vector<Index>& representative) {
    constexpr std::size_t few = 32; // up to this many different wedges are compared linearly
    different.clear();
    for (std::size_t i = 0; i < wedges.size() && different.size() <= few; ++i) {
        const Index w = wedges[i];
        const auto same = std::find_if(different.begin(), different.end(),
                                       [&](Index other) { return bits.compare(other, w) == 0; });
        representative[w] = same == different.end() ? w : *same;
        if (same == different.end()) different.push_back(w);
    }
    if (different.size() <= few) return;
    std::vector<Index> sorted(wedges.begin(), wedges.end());
    std::sort(sorted.begin(), sorted.end(), [&](Index a, Index b) {
        const int order = bits.compare(a, b);
        return order != 0 ? order < 0 : a < b;
    });
    for (std::size_t i = 0; i < sorted.size(); ++i)
        representative[sorted[i]] =
            i > 0 && bits.compare(sorted[i - 1], sorted[i]) == 0 ? representative[sorted[i - 1]] : sorted[i];
}

/// Keeps only wedges that represent themselves, in order, with their attributes.
void keep_representatives(Mesh& mesh, const std::vector<Index>& representative) {
    std::vector<Index> kept, number(representative.size());
    for (Index w = 0; w < representative.size(); ++w)
        if (representative[w] == w) {
            number[w] = static_cast<Index>(kept.size());
            kept.push_back(w);
        }
    if (kept.size() == representative.size()) return;
    for (auto* indices : {&mesh.corners, &mesh.lines})
        parallel_for(indices->size(),
                     [&](std::size_t i) { (*indices)[i] = number[representative[(*indices)[i]]]; });
    for (auto& a : mesh.attributes)
        if (a.domain == Domain::wedge) a.select(kept);
    std::vector<Index> vertices(kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i) vertices[i] = mesh.wedge_vertex[kept[i]];
    mesh.wedge_vertex = std::move(vertices);
}

} // namespace

std::size_t merge_equal_wedges(Mesh& mesh) {
    if (!mesh.has_seams()) return 0;
    const std::size_t before = mesh.wedge_count();
    const Groups groups = wedges_of_vertices(mesh);
    const WedgeBits bits(mesh);
    std::vector<Index> representative(mesh.wedge_count());
    parallel_chunks(mesh.vertex_count(), [&](std::size_t begin, std::size_t end) {
        std::vector<Index> different;
        for (std::size_t v = begin; v < end; ++v)
            find_representatives(
                {groups.wedges.data() + groups.offsets[v], groups.wedges.data() + groups.offsets[v + 1]},
                bits, different, representative);
    });
    keep_representatives(mesh, representative);
    const std::size_t merged = before - mesh.wedge_count();
    normalise_wedges(mesh);
    return merged;
}

std::size_t merge_and_drop_wedges(Mesh& mesh) {
    const std::size_t merged = merge_equal_wedges(mesh);
    if (merged > 0 && (mesh.face_count() > 0 || mesh.line_count() > 0)) drop_unused(mesh);
    return merged;
}

} // namespace facetmill
