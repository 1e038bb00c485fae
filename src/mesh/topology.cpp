#include "mesh/topology.hpp"

#include "mesh/buckets.hpp"
#include "mesh/weld.hpp"

#include <algorithm>
#include <bit>

namespace facetmill {

std::vector<Index> corner_faces(const Mesh& mesh) {
    std::vector<Index> faces(mesh.corner_count());
    if (mesh.all_triangles()) {
        parallel_for(faces.size(), [&](std::size_t c) { faces[c] = static_cast<Index>(c / 3); });
        return faces;
    }
    parallel_for(mesh.face_count(), [&](std::size_t f) {
        const auto i = static_cast<Index>(f);
        for (Index c = mesh.face_begin(i); c < mesh.face_end(i); ++c) faces[c] = i;
    });
    return faces;
}

namespace {

struct HalfEdge {
    Index low, high, corner;
};

/// Sorts a bucket by (low, high, corner): a counting sort by low vertex, then an insertion sort of each
/// vertex's few items.
void sort_bucket(std::span<HalfEdge> items, Index first_vertex, std::size_t vertices,
                 std::vector<HalfEdge>& room, std::vector<Index>& counts) {
    room.assign(items.begin(), items.end());
    counts.assign(vertices + 1, 0);
    for (const auto& h : room) ++counts[h.low - first_vertex];
    exclusive_scan(counts);
    for (const auto& h : room) items[counts[h.low - first_vertex]++] = h;
    const auto before = [](const HalfEdge& a, const HalfEdge& b) {
        return a.high != b.high ? a.high < b.high : a.corner < b.corner;
    };
    std::size_t begin = 0;
    for (std::size_t v = 0; v < vertices; ++v) {
        const std::size_t end = counts[v]; // the end of v's items after the scatter
        if (end - begin > 16) {
            std::sort(items.begin() + static_cast<std::ptrdiff_t>(begin),
                      items.begin() + static_cast<std::ptrdiff_t>(end), before);
        } else {
            for (std::size_t i = begin + 1; i < end; ++i) {
                const HalfEdge item = items[i];
                std::size_t j = i;
                for (; j > begin && before(item, items[j - 1]); --j) items[j] = items[j - 1];
                items[j] = item;
            }
        }
        begin = end;
    }
}

Buckets<HalfEdge> sorted_half_edges(const Mesh& mesh) {
    auto buckets = fill_buckets<HalfEdge>(mesh, [&](Index f, auto&& emit) {
        const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
        if (begin == end) return;
        Index c = end - 1, from = mesh.vertex(c);
        for (Index n = begin; n < end; c = n++) {
            const Index to = mesh.vertex(n);
            if (from != to) emit(std::min(from, to), HalfEdge{std::min(from, to), std::max(from, to), c});
            from = to;
        }
    });
    parallel_chunks(
        buckets.count(),
        [&](std::size_t first, std::size_t last) {
            std::vector<HalfEdge> room;
            std::vector<Index> counts;
            for (std::size_t b = first; b < last; ++b)
                sort_bucket(
                    {buckets.items.data() + buckets.begin[b], buckets.items.data() + buckets.begin[b + 1]},
                    static_cast<Index>(b << buckets.shift), std::size_t{1} << buckets.shift, room, counts);
        },
        buckets.at_once());
    return buckets;
}

bool same_edge(const HalfEdge& a, const HalfEdge& b) { return a.low == b.low && a.high == b.high; }

} // namespace

EdgeTable build_edges(const Mesh& mesh) {
    const auto buckets = sorted_half_edges(mesh);
    const auto& items = buckets.items;
    std::vector<Index> first_edge(buckets.count());
    parallel_for(
        buckets.count(),
        [&](std::size_t b) { // an edge never belongs to two buckets
            Index count = 0;
            for (std::size_t i = buckets.begin[b]; i < buckets.begin[b + 1]; ++i)
                count += i == buckets.begin[b] || !same_edge(items[i], items[i - 1]);
            first_edge[b] = count;
        },
        buckets.at_once());
    EdgeTable table;
    const Index edges = exclusive_scan(first_edge);
    resize_large(table.edges, edges);
    resize_large(table.corner_offsets, std::size_t{edges} + 1);
    table.corner_offsets[edges] = static_cast<Index>(items.size());
    resize_large(table.edge_corners, items.size());
    resize_large(table.corner_edge, mesh.corner_count(), none);
    parallel_for(
        buckets.count(),
        [&](std::size_t b) {
            Index e = first_edge[b] - 1;
            for (std::size_t i = buckets.begin[b]; i < buckets.begin[b + 1]; ++i) {
                if (i == buckets.begin[b] || !same_edge(items[i], items[i - 1])) {
                    table.edges[++e] = {items[i].low, items[i].high};
                    table.corner_offsets[e] = static_cast<Index>(i);
                }
                table.edge_corners[i] = items[i].corner;
                table.corner_edge[items[i].corner] = e;
            }
        },
        buckets.at_once());
    return table;
}

namespace {

/// Edges with a wanted number of faces; an entry for each face.
template <class Wanted>
std::vector<BoundaryEdge> edges_of_faces(const Mesh& mesh, Wanted&& wanted) {
    const auto edges = build_edges(mesh);
    const auto faces = corner_faces(mesh);
    std::vector<BoundaryEdge> all;
    for (Index e = 0; e < edges.size(); ++e) {
        const auto corners = edges.corners_of(e);
        if (!wanted(corners.size())) continue;
        for (const Index c : corners)
            all.push_back({c, faces[c], mesh.vertex(c), mesh.vertex(next_corner(mesh, faces[c], c))});
    }
    return all;
}

} // namespace

std::vector<BoundaryEdge> boundary_edges(const Mesh& mesh) {
    return edges_of_faces(mesh, [](std::size_t faces) { return faces == 1; });
}

std::vector<BoundaryEdge> odd_edges(const Mesh& mesh) {
    return edges_of_faces(mesh, [](std::size_t faces) { return faces % 2 == 1; });
}

std::vector<Index> lowest_at_place(const Mesh& mesh) {
    std::vector<Index> lowest = first_at_position(mesh.positions);
    if (!lowest.empty()) return lowest;
    lowest.resize(mesh.vertex_count());
    parallel_for(lowest.size(), [&](std::size_t v) { lowest[v] = static_cast<Index>(v); });
    return lowest;
}

VertexLists corners_at_vertices(const Mesh& mesh) {
    struct Item {
        Index vertex, corner;
    };
    const auto buckets = fill_buckets<Item>(mesh, [&](Index f, auto&& emit) {
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            emit(mesh.vertex(c), Item{mesh.vertex(c), c});
    });
    VertexLists lists;
    const std::size_t vertices = mesh.vertex_count();
    lists.offsets.resize(vertices + 1);
    lists.offsets[vertices] = static_cast<Index>(buckets.items.size());
    lists.items.resize(buckets.items.size());
    parallel_for(
        buckets.count(),
        [&](std::size_t b) {
            const std::size_t first = b << buckets.shift, last = std::min(vertices, (b + 1) << buckets.shift);
            std::vector<Index> counts(last - first, 0);
            for (std::size_t i = buckets.begin[b]; i < buckets.begin[b + 1]; ++i)
                ++counts[buckets.items[i].vertex - first];
            exclusive_scan(counts);
            for (std::size_t v = first; v < last; ++v)
                lists.offsets[v] = static_cast<Index>(buckets.begin[b]) + counts[v - first];
            for (std::size_t i = buckets.begin[b]; i < buckets.begin[b + 1]; ++i)
                lists.items[buckets.begin[b] + counts[buckets.items[i].vertex - first]++] =
                    buckets.items[i].corner;
        },
        buckets.at_once());
    return lists;
}

namespace {
Index load(Index& i) { return std::atomic_ref(i).load(std::memory_order_relaxed); }
} // namespace

DisjointSets::DisjointSets(std::size_t n) : parent_(n) {
    parallel_for(n, [&](std::size_t i) { parent_[i] = static_cast<Index>(i); });
}

Index DisjointSets::add() {
    parent_.push_back(static_cast<Index>(parent_.size()));
    return parent_.back();
}

Index DisjointSets::find(Index i) {
    for (;;) {
        const Index p = load(parent_[i]), above = load(parent_[p]);
        if (p == above) return p;
        Index expected = p; // halves the path; another thread may have been faster
        std::atomic_ref(parent_[i]).compare_exchange_weak(expected, above, std::memory_order_relaxed);
        i = above;
    }
}

void DisjointSets::join_apart(Index a, Index b) {
    for (;;) {
        a = find(a);
        b = find(b);
        if (a == b) return;
        if (a > b) std::swap(a, b);
        Index expected = b;
        if (std::atomic_ref(parent_[b]).compare_exchange_strong(expected, a, std::memory_order_relaxed))
            return;
    }
}

std::size_t DisjointSets::count() {
    std::size_t roots = 0;
    for (Index i = 0; i < parent_.size(); ++i) roots += find(i) == i;
    return roots;
}

namespace {

void join_corners(const Mesh& mesh, DisjointSets& vertices) {
    parallel_for(mesh.face_count(), [&](std::size_t f) {
        const Index begin = mesh.face_begin(static_cast<Index>(f)),
                    end = mesh.face_end(static_cast<Index>(f));
        for (Index c = begin + 1; c < end; ++c) vertices.join(mesh.vertex(c - 1), mesh.vertex(c));
    });
}

/// Converts roots to numbers, in the order of the first face with each root.
Components numbered(std::vector<Index> roots, std::size_t elements) {
    Components result;
    std::vector<Index> number(elements, none);
    for (Index& r : roots) {
        if (number[r] == none) number[r] = static_cast<Index>(result.count++);
        r = number[r];
    }
    result.of_face = std::move(roots);
    return result;
}

} // namespace

std::size_t component_count(const Mesh& mesh) {
    DisjointSets sets(mesh.vertex_count());
    join_corners(mesh, sets);
    std::vector<std::uint8_t> is_root(mesh.vertex_count(),
                                      0); // only roots of faces, which excludes isolated vertices
    parallel_for(mesh.corner_count(), [&](std::size_t c) {
        const Index v = mesh.vertex(static_cast<Index>(c));
        if (sets.find(v) == v) std::atomic_ref(is_root[v]).store(1, std::memory_order_relaxed);
    });
    return static_cast<std::size_t>(std::count(is_root.begin(), is_root.end(), 1));
}

Components face_components(const Mesh& mesh, bool by_vertex) {
    if (by_vertex) {
        const std::size_t faces = mesh.face_count();
        std::vector<Index> roots(faces);
        DisjointSets sets(mesh.vertex_count());
        parallel_for(faces, [&](std::size_t f) {
            const Index begin = mesh.face_begin(static_cast<Index>(f)),
                        end = mesh.face_end(static_cast<Index>(f));
            for (Index c = begin + 1; c < end; ++c) sets.join(mesh.vertex(c - 1), mesh.vertex(c));
        });
        parallel_for(faces, [&](std::size_t f) {
            roots[f] = sets.find(mesh.vertex(mesh.face_begin(static_cast<Index>(f))));
        });
        return numbered(std::move(roots), mesh.vertex_count());
    }
    return face_components(mesh, build_edges(mesh));
}

Components face_components(const Mesh& mesh, const EdgeTable& edges) {
    const std::size_t faces = mesh.face_count();
    std::vector<Index> roots(faces);
    const auto face_of = corner_faces(mesh);
    DisjointSets sets(faces);
    parallel_for(edges.size(), [&](std::size_t e) {
        const auto corners = edges.corners_of(static_cast<Index>(e));
        for (std::size_t i = 1; i < corners.size(); ++i) sets.join(face_of[corners[0]], face_of[corners[i]]);
    });
    parallel_for(faces, [&](std::size_t f) { roots[f] = sets.find(static_cast<Index>(f)); });
    return numbered(std::move(roots), faces);
}

} // namespace facetmill
