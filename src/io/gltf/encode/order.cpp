#include "io/gltf/encode/order.hpp"

#include "geometry/spatial/hilbert_curve.hpp"
#include "io/gltf/numbers/compress.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <meshoptimizer.h>
#include <numeric>
#include <span>

namespace facetmill::io::gltf {

namespace {

constexpr std::uint32_t cache_size = 16;
constexpr std::size_t few_corners = 3 * 1000; ///< below this size, starting a thread takes longer

/// A FIFO cache of vertices.
class VertexCache {
  public:
    explicit VertexCache(std::size_t vertices) : entered_(vertices, 0) {}

    /// True if the vertex is not in the cache and must be transformed.
    bool misses(Index v) {
        if (now_ - entered_[v] <= cache_size) return false;
        entered_[v] = now_++;
        return true;
    }
    void clear() { now_ += cache_size + 1; }

  private:
    std::vector<std::uint32_t> entered_;
    std::uint32_t now_ = cache_size + 1;
};

std::size_t transforms(const Table& table) {
    VertexCache cache(table.wedges.size());
    std::size_t count = 0;
    for (const Index w : table.indices) count += cache.misses(w) ? 1 : 0;
    return count;
}

/// The number of cache misses of each triangle.
std::vector<std::uint8_t> misses_by_triangle(const Table& table) {
    VertexCache cache(table.wedges.size());
    std::vector<std::uint8_t> misses(table.indices.size() / 3);
    for (std::size_t c = 0; c < table.indices.size(); ++c)
        misses[c / 3] = static_cast<std::uint8_t>(misses[c / 3] + (cache.misses(table.indices[c]) ? 1 : 0));
    return misses;
}

/// The first triangles of groups that share hardly any cached vertices. A group ends where all three vertices
/// miss anyway, once it uses the cache as well as the whole mesh does, within 5 %.
std::vector<std::size_t> groups_of(const Table& table) {
    constexpr double threshold = 1.05;
    const std::vector<std::uint8_t> misses = misses_by_triangle(table);
    const double whole = std::accumulate(misses.begin(), misses.end(), 0.0);
    const double most = threshold * whole / static_cast<double>(misses.size());
    std::vector<std::size_t> starts;
    VertexCache own(table.wedges.size());
    std::size_t begin = 0, missed = 0;
    for (std::size_t t = 0; t < misses.size(); ++t) {
        const bool good = t > begin && static_cast<double>(missed) <= most * static_cast<double>(t - begin);
        if (t == 0 || misses[t] == 3 || good) {
            starts.push_back(t);
            begin = t;
            missed = 0;
            own.clear();
        }
        for (std::size_t k = 0; k < 3; ++k) missed += own.misses(table.indices[3 * t + k]) ? 1 : 0;
    }
    return starts;
}

/// Sorts groups of triangles. Groups that face away from the centre come first, because they hide the others.
void order_groups(const Mesh& mesh, Table& table) {
    const auto place = [&](std::size_t corner) {
        return mesh.positions[mesh.vertex_of_wedge(table.wedges[table.indices[corner]])];
    };
    std::vector<std::size_t> starts;
    Vec3 sum;
    const auto add_up = [&] {
        for (std::size_t c = 0; c < table.indices.size(); ++c)
            sum += place(c) / static_cast<double>(table.indices.size());
    };
    const std::size_t at_once = table.indices.size() < few_corners ? 2 : 1;
    parallel_for(
        2, [&](std::size_t i) { i == 0 ? add_up() : void(starts = groups_of(table)); }, at_once);
    const std::size_t groups = starts.size(), triangles = table.indices.size() / 3;
    starts.push_back(triangles);
    std::vector<double> outwards(groups);
    parallel_for(groups, [&](std::size_t g) {
        Vec3 normal, centre;
        double area = 0;
        for (std::size_t t = starts[g]; t < starts[g + 1]; ++t) {
            const Vec3 a = place(3 * t), b = place(3 * t + 1), c = place(3 * t + 2);
            const Vec3 n = cross(b - a, c - a);
            normal += n;
            area += length(n);
            centre += (a + b + c) * (length(n) / 3);
        }
        const double size = length(normal);
        outwards[g] = area > 0 && size > 0 ? dot(centre / area - sum, normal) / size : 0;
    });
    std::vector<std::size_t> order(groups);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return outwards[a] > outwards[b]; });
    std::vector<Index> ordered;
    ordered.reserve(table.indices.size());
    for (const std::size_t g : order)
        ordered.insert(ordered.end(), table.indices.begin() + static_cast<std::ptrdiff_t>(3 * starts[g]),
                       table.indices.begin() + static_cast<std::ptrdiff_t>(3 * starts[g + 1]));
    table.indices = std::move(ordered);
}

/// Sorts the wedges by first use in the triangles of the tables.
void order_wedges(std::vector<Table*>& tables) {
    const std::vector<Index> before = tables.front()->wedges;
    std::vector<Index> number(before.size(), none), after;
    after.reserve(before.size());
    for (Table* table : tables)
        for (Index& w : table->indices) {
            if (number[w] == none) {
                number[w] = static_cast<Index>(after.size());
                after.push_back(before[w]);
            }
            w = number[w];
        }
    for (Table* table : tables) table->wedges = after;
}

void add_sizes(const Table& table, VertexCacheUse& use) {
    use.triangles += table.indices.size() / 3;
    use.vertices += table.wedges.size();
}

/// The size of meshopt's streams for triangles and 14-bit corner positions, when vertices are numbered by
/// first use.
std::size_t stream_bytes(const Mesh& mesh, const Table& table, const std::vector<Index>& indices,
                         const Box& box) {
    std::vector<Index> number(table.wedges.size(), none), numbered;
    std::vector<std::array<std::uint16_t, 4>> places;
    numbered.reserve(indices.size());
    places.reserve(table.wedges.size());
    const Vec3 e = box.extent();
    const double steps = 16383 / std::max({e.x, e.y, e.z, 1e-300});
    for (const Index w : indices) {
        if (number[w] == none) {
            number[w] = static_cast<Index>(places.size());
            const Vec3 p = (mesh.positions[mesh.vertex_of_wedge(table.wedges[w])] - box.min) * steps;
            auto& place = places.emplace_back();
            for (std::size_t c = 0; c < 3; ++c)
                place[c] = static_cast<std::uint16_t>(p[c] > 0 ? std::min(p[c] + 0.5, 16383.0) : 0);
        }
        numbered.push_back(number[w]);
    }
    const Packing corners{"TRIANGLES", "", sizeof(Index), numbered.size()},
        vertices{"ATTRIBUTES", "", sizeof(places[0]), places.size()};
    return encode_meshopt(std::as_bytes(std::span(numbered)), corners, 0).size() +
           encode_meshopt(std::as_bytes(std::span(places)), vertices, 0).size();
}

/// A triangle, and its position along an axis as a sortable integer.
struct Placed {
    std::uint64_t key;
    Index triangle;
};

/// The triangles sorted by the sum of their corners' coordinates; equal sums stay in order.
std::vector<Placed> triangles_along(const Mesh& mesh, const Table& table, std::size_t axis) {
    std::vector<Placed> sorted(table.indices.size() / 3);
    for (std::size_t t = 0; t < sorted.size(); ++t) {
        double sum = 0;
        for (std::size_t c = 3 * t; c < 3 * t + 3; ++c)
            sum += mesh.positions[mesh.vertex_of_wedge(table.wedges[table.indices[c]])][axis];
        const auto bits = std::bit_cast<std::uint64_t>(sum + 0.0); // -0 + 0 is 0
        constexpr std::uint64_t sign = std::uint64_t{1} << 63;
        sorted[t] = {bits & sign ? ~bits : bits | sign, static_cast<Index>(t)};
    }
    radix_sort(sorted, [](const Placed& p) { return p.key; });
    return sorted;
}

/// The corners of the triangles, forward or backward; triangles at the same position stay in order either
/// way.
std::vector<Index> corners_along(const Table& table, const std::vector<Placed>& sorted, bool back) {
    std::vector<Index> corners;
    corners.reserve(3 * sorted.size());
    const auto add = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto from = table.indices.begin() + std::ptrdiff_t{3} * sorted[i].triangle;
            corners.insert(corners.end(), from, from + 3);
        }
    };
    if (!back) add(0, sorted.size());
    for (std::size_t end = sorted.size(), begin = end; back && end > 0; end = begin) {
        while (begin > 0 && sorted[begin - 1].key == sorted[end - 1].key) --begin;
        add(begin, end);
    }
    return corners;
}

/// A function of meshoptimizer.
using Optimize = void (*)(Index* to, const Index* corners, std::size_t count, std::size_t vertices);

/// Limits meshoptimizer's time: for each triangle that it adds, it examines all triangles of a vertex. If
/// thousands of triangles meet at a vertex, each gets a separate copy of the vertex during the call.
void order_by(Optimize optimize, std::vector<Index>& corners, std::size_t vertices) {
    constexpr Index many = 4096;
    std::vector<Index> at(vertices), apart; // triangle counts by vertex; copied vertices
    for (const Index v : corners) ++at[v];
    for (Index& v : corners)
        if (at[v] > many) {
            apart.push_back(v);
            v = static_cast<Index>(vertices + apart.size() - 1);
        }
    optimize(corners.data(), corners.data(), corners.size(), vertices + apart.size());
    for (Index& v : corners)
        if (v >= vertices) v = apart[v - vertices];
}

/// Reorders triangles as strips, starting from the given order.
void order_in_strips(std::vector<Index>& corners, std::size_t vertices) {
    order_by(meshopt_optimizeVertexCacheStrip, corners, vertices);
}

/// Reorders triangles for vertex caches.
void order_for_cache(std::vector<Index>& corners, std::size_t vertices) {
    order_by(meshopt_optimizeVertexCache, corners, vertices);
}

/// The triangles along a space-filling curve, so that consecutive triangles are close to each other.
std::vector<Index> corners_along_curve(const Mesh& mesh, const Table& table, const Box& box) {
    const std::size_t triangles = table.indices.size() / 3;
    const std::vector<Index> order = order_along_curve(triangles, box, [&](std::size_t t) {
        Vec3 sum;
        for (std::size_t c = 3 * t; c < 3 * t + 3; ++c)
            sum += mesh.positions[mesh.vertex_of_wedge(table.wedges[table.indices[c]])] / 3;
        return sum;
    });
    std::vector<Index> corners(table.indices.size());
    parallel_for(triangles, [&](std::size_t t) {
        for (std::size_t k = 0; k < 3; ++k) corners[3 * t + k] = table.indices[3 * std::size_t{order[t]} + k];
    });
    return corners;
}

/// Reorders each chunk of `length` corners for vertex caches.
void order_stretches_for_cache(std::vector<Index>& corners, std::size_t vertices, std::size_t length) {
    const std::size_t stretches = (corners.size() + length - 1) / length;
    constexpr std::size_t tables = 8; // memory limit: tables with a number per vertex
    parallel_chunks(
        stretches,
        [&](std::size_t begin, std::size_t end) {
            std::vector<Index> number(vertices, none), own, used;
            for (std::size_t s = begin; s < end; ++s) {
                const auto stretch =
                    std::span(corners).subspan(s * length, std::min(length, corners.size() - s * length));
                own.clear();
                used.clear();
                for (const Index v : stretch) {
                    if (number[v] == none) {
                        number[v] = static_cast<Index>(used.size());
                        used.push_back(v);
                    }
                    own.push_back(number[v]);
                }
                order_for_cache(own, used.size());
                for (std::size_t c = 0; c < own.size(); ++c) stretch[c] = used[own[c]];
                for (const Index v : used) number[v] = none;
            }
        },
        (stretches + tables - 1) / tables);
}

/// Reorders triangles for vertex caches. Large meshes are processed in parallel chunks. Vertices at chunk
/// borders (about one in a hundred) are transformed twice.
void order_for_cache(const Mesh& mesh, Table& table, const Box& box) {
    constexpr std::size_t stretch = 1 << 18; // triangles in a chunk
    if (table.indices.size() / 3 < 2 * stretch) return order_for_cache(table.indices, table.wedges.size());
    table.indices = corners_along_curve(mesh, table, box);
    order_stretches_for_cache(table.indices, table.wedges.size(), 3 * stretch);
}

/// Flags the orders from `first` on that equal an earlier order, as is common for small meshes.
void mark_repeated(const std::vector<std::vector<Index>>& orders, std::size_t first,
                   std::vector<std::uint8_t>& again) {
    for (std::size_t i = first; i < orders.size(); ++i)
        for (std::size_t j = first; j < i && !again[i]; ++j) again[i] = !again[j] && orders[j] == orders[i];
}

/// Tries several orders and takes the smallest result: the order for caches, and strips started from it, from
/// the given order, and from those strips. Meshes that are not large also try strips started along the axes,
/// forward and backward, which saves about a percent.
void order_for_size(const Mesh& mesh, Table& table, const Box& box) {
    constexpr std::size_t large = 100000; // triangles in a large mesh
    const std::size_t vertices = table.wedges.size(), corners = table.indices.size();
    std::vector<std::vector<Index>> orders(4, table.indices);
    if (corners / 3 <= large) orders.resize(10);
    order_for_cache(orders[0], vertices);
    orders[1] = orders[0];
    order_in_strips(orders[1], vertices);
    orders[2] = orders[1];
    const std::size_t at_once = corners < few_corners ? orders.size() : 1;
    std::vector<Placed> along[3];
    if (orders.size() > 4)
        parallel_for(
            3, [&](std::size_t axis) { along[axis] = triangles_along(mesh, table, axis); }, at_once);
    const auto for_orders = [&](const auto& body) { parallel_for(orders.size(), body, at_once); };
    for_orders([&](std::size_t i) {
        if (i >= 4) orders[i] = corners_along(table, along[(i - 4) % 3], i >= 7);
    });
    std::vector<std::uint8_t> again(orders.size());
    mark_repeated(orders, 2, again); // equal starting orders give equal strips
    for_orders([&](std::size_t i) {
        if (i >= 2 && !again[i]) order_in_strips(orders[i], vertices);
    });
    mark_repeated(orders, 0, again);
    std::vector<std::size_t> bytes(orders.size(), SIZE_MAX);
    for_orders([&](std::size_t i) {
        if (!again[i]) bytes[i] = stream_bytes(mesh, table, orders[i], box);
    });
    const auto fewest = std::min_element(bytes.begin(), bytes.end()) - bytes.begin();
    table.indices = std::move(orders[static_cast<std::size_t>(fewest)]);
}

} // namespace

void order_triangles(const Mesh& mesh, std::vector<Table>& tables, TriangleOrder order, bool shared,
                     VertexCacheUse& use) {
    std::vector<Table*> together;
    const Box box = mesh.bounds();
    for (Table& table : tables) {
        use.before += transforms(table);
        if (order == TriangleOrder::size) {
            order_for_size(mesh, table, box);
        } else {
            order_for_cache(mesh, table, box);
            if (order == TriangleOrder::draw) order_groups(mesh, table);
            for (int i = 0; order == TriangleOrder::strips && i < 2; ++i) // makes strips of strips
                order_in_strips(table.indices, table.wedges.size());
        }
        together.push_back(&table);
        if (shared) continue;
        order_wedges(together);
        together.clear();
    }
    if (shared) order_wedges(together);
    for (const Table& table : tables) {
        use.after += transforms(table);
        add_sizes(table, use);
    }
}

bool orders_points(TriangleOrder order) {
    return order == TriangleOrder::size || order == TriangleOrder::strips;
}

std::vector<Index> points_along_curve(const Mesh& mesh) {
    return order_along_curve(mesh.wedge_count(), mesh.bounds(), [&](std::size_t w) {
        return mesh.positions[mesh.vertex_of_wedge(static_cast<Index>(w))];
    });
}

} // namespace facetmill::io::gltf
