// Vertex clustering: the vertices in each cell of a grid become one, placed where their planes meet best.
// After J. Rossignac and P. Borrel (1993) and P. Lindstrom, 'Out-of-core simplification of large polygonal
// models' (2000).

#include "geometry/simplify/cluster.hpp"
#include "base/parallel.hpp"
#include "geometry/simplify/judge.hpp"

#include <bit>

namespace facetmill::simplification {

namespace {

constexpr std::uint32_t finest = 1u << 20; // cells along an axis
// How strongly a representative is drawn to the mean of its vertices: enough that a flat cell's stays there.
constexpr double pull = 1e-3;

struct Keyed {
    std::uint64_t key;
    Index vertex;
};

/// The vertices of a cell, as a range of the sorted ones.
struct Cell {
    std::size_t begin, end;
};

/// The work's frame is [-1, 1] along each axis.
class Grid {
  public:
    explicit Grid(std::uint32_t n) : n_(n), bits_(std::bit_width(n - 1)) {}
    std::uint64_t key(const Vec3& p) const {
        return (cell(p.x) << (2 * bits_)) | (cell(p.y) << bits_) | cell(p.z);
    }
    int key_bits() const { return std::max(1, 3 * bits_); }
    double edge() const { return 2.0 / n_; }
    /// Whether p lies in the cell of q.
    bool together(const Vec3& p, const Vec3& q) const { return is_finite(p) && key(p) == key(q); }

  private:
    std::uint64_t cell(double x) const {
        const double at = (x + 1) / 2 * n_; // what is no number is in the first cell
        return at > 0 ? std::min(static_cast<std::uint64_t>(std::min(at, 4e9)), std::uint64_t{n_} - 1) : 0;
    }
    std::uint32_t n_;
    int bits_;
};

/// Faces with three vertices in three cells; some of them may coincide.
std::size_t count_faces(const Work& s, const Grid& grid) {
    std::vector<std::uint64_t> keys(s.vertex_slots());
    parallel_for(keys.size(), [&](std::size_t v) { keys[v] = grid.key(s.at[v]); });
    return parallel_reduce(
        s.face_slots(), std::size_t{0},
        [&](std::size_t begin, std::size_t end) {
            std::size_t count = 0;
            for (std::size_t c = 3 * begin; c < 3 * end; c += 3) {
                const auto x = keys[s.tri[c]], y = keys[s.tri[c + 1]], z = keys[s.tri[c + 2]];
                count += x != y && y != z && z != x;
            }
            return count;
        },
        [](std::size_t a, std::size_t b) { return a + b; });
}

/// The vertices by cell, and the cells.
std::vector<Cell> sort_cells(const Work& s, const Grid& grid, std::vector<Keyed>& order) {
    order.resize(s.vertex_slots());
    parallel_for(order.size(), [&](std::size_t v) { order[v] = {grid.key(s.at[v]), static_cast<Index>(v)}; });
    radix_sort(
        order, [](const Keyed& k) { return k.key; }, grid.key_bits());
    std::vector<Cell> cells;
    for (std::size_t i = 0; i < order.size(); ++i)
        if (i == 0 || order[i].key != order[i - 1].key)
            cells.push_back({i, i + 1});
        else
            cells.back().end = i + 1;
    return cells;
}

/// Where the vertices of a cell meet. Returns the error, squared.
double place_cell(const Work& s, const Grid& grid, std::span<const Keyed> members, Vec3& at) {
    const Index root = members.front().vertex;
    if (members.size() == 1) return at = s.at[root], 0;
    Quadric q;
    Vec3 mean;
    const Vec3 from = s.at[root];
    for (const Keyed& k : members) {
        const Vec3 off = s.at[k.vertex] - from;
        q += seen_from(s.quadrics[k.vertex], -off), mean += off;
    }
    mean = mean / static_cast<double>(members.size());
    const Vec3 best = q.weight > 0 ? q.least(mean, pull * q.weight) : mean;
    at = from + best;
    if (!grid.together(at, from)) at = is_finite(mean) ? from + mean : from;
    return q.weight > 0 ? q(at - from) / q.weight : 0;
}

Clusters cluster(const Work& s, const Grid& grid) {
    Clusters c;
    std::vector<Keyed> order;
    const auto cells = sort_cells(s, grid, order);
    c.vertices = cells.size();
    c.root.resize(s.vertex_slots()), c.at.resize(s.vertex_slots());
    c.largest = parallel_reduce(
        cells.size(), 0.0,
        [&](std::size_t begin, std::size_t end) {
            double largest = 0;
            for (std::size_t i = begin; i < end; ++i) {
                const std::span<const Keyed> members(&order[cells[i].begin], cells[i].end - cells[i].begin);
                const Index root = members.front().vertex;
                for (const Keyed& k : members) c.root[k.vertex] = root;
                largest = std::max(largest, place_cell(s, grid, members, c.at[root]));
            }
            return largest;
        },
        [](double a, double b) { return std::max(a, b); });
    keep_faces(s, c);
    return c;
}

/// Follows an element of a forest to its root, and shortens the way.
Index find(std::vector<Index>& parent, Index e) {
    while (parent[e] != e) e = parent[e] = parent[parent[e]];
    return e;
}

/// Wedges that faces join within a cell become one: an island of a texture stays apart from the others.
std::vector<Index> join_wedges(const Work& s, const Clusters& c) {
    std::vector<Index> parent(
        s.wedge.empty() ? 0 : *std::max_element(s.wedge.begin(), s.wedge.end()) + std::size_t{1});
    for (std::size_t w = 0; w < parent.size(); ++w) parent[w] = static_cast<Index>(w);
    for (Index corner = 0; corner < s.wedge.size(); ++corner) {
        const Index other = after(corner);
        if (c.root[s.tri[corner]] != c.root[s.tri[other]]) continue;
        const Index a = find(parent, s.wedge[corner]), b = find(parent, s.wedge[other]);
        parent[std::max(a, b)] = std::min(a, b);
    }
    for (std::size_t w = 0; w < parent.size(); ++w) parent[w] = find(parent, static_cast<Index>(w));
    return parent;
}

/// Makes the clusters the state of the work.
void settle(Work& s, const Clusters& c) {
    const std::vector<Index> wedges = join_wedges(s, c);
    for (Index v = 0; v < s.vertex_slots(); ++v) {
        const Index root = c.root[v];
        if (root == v) continue;
        s.moved[root] = 1;
        if (s.logging) s.log.steps.push_back({s.source[root], s.source[v], 0, 0, c.at[root]});
    }
    for (Index w = 0; w < wedges.size(); ++w)
        if (s.logging && wedges[w] != w) s.log.wedges.push_back({wedges[w], w});
    std::vector<Index> tri, wedge, source;
    for (const Index f : c.faces) {
        source.push_back(s.face_source[f]);
        for (std::size_t k = 0; k < 3; ++k) {
            tri.push_back(c.root[s.tri[3 * f + k]]);
            if (!s.wedge.empty()) wedge.push_back(wedges[s.wedge[3 * f + k]]);
        }
    }
    for (std::size_t v = 0; v < s.vertex_slots(); ++v)
        if (s.moved[v]) s.at[v] = c.at[v];
    s.tri.swap(tri), s.wedge.swap(wedge), s.face_source.swap(source);
    s.flags.clear(), s.cost.clear(), s.quadrics.clear(), s.kind.clear(), s.touched.clear(), s.dirty.clear(),
        s.limit.clear();
    s.fields = {};
    build_lists(s);
    s.live_faces = s.face_slots();
    s.live_vertices = static_cast<std::size_t>(
        std::count_if(s.first.begin(), s.first.end(), [](Index corner) { return corner != none; }));
}

/// The shape of clusters: positions and faces only.
Mesh shape_of(const Work& s, const Clusters& c) {
    Mesh mesh;
    mesh.positions.resize(s.vertex_slots());
    parallel_for(mesh.positions.size(), [&](std::size_t v) {
        mesh.positions[v] = (c.root[v] == v ? c.at[v] : s.at[v]) / s.scale + s.centre;
    });
    for (const Index f : c.faces)
        for (std::size_t k = 0; k < 3; ++k) mesh.corners.push_back(c.root[s.tri[3 * f + k]]);
    drop_unused(mesh);
    return mesh;
}

/// The finest grid found whose count is at most so much. Counts grow with the square of the cells along an
/// axis, which tells where to look.
template <class Count>
std::uint32_t finest_within(const Work& s, std::size_t most, Count&& count) {
    if (most == 0) return 1;
    std::uint32_t good = 1, bad = finest + 1;
    double guess = std::sqrt(static_cast<double>(s.live_faces)) * 0.25;
    while (bad - good > 1) {
        const auto n = static_cast<std::uint32_t>(std::clamp(guess, good + 1.0, bad - 1.0));
        const double now = static_cast<double>(count(Grid(n))) / static_cast<double>(most);
        (now <= 1 ? good : bad) = n;
        if (now <= 1 && now > 0.98) break;
        guess = n * std::sqrt(1 / std::max(now, 1e-6)) * 0.995;
        if (guess <= good || guess >= bad) guess = good + (bad - good) / 2.0;
        if (bad <= finest && bad - good <= std::max(1u, good / 512)) break;
    }
    return good;
}

/// As fine as the goal, one or the other part of it, allows.
std::uint32_t finest_within(const Work& s, const Goal& goal) {
    std::vector<Keyed> order;
    return std::max(
        finest_within(s, goal.faces, [&](const Grid& grid) { return count_faces(s, grid); }),
        finest_within(s, goal.vertices, [&](const Grid& grid) { return sort_cells(s, grid, order).size(); }));
}

/// No clusters: every vertex by itself.
Clusters unclustered(const Work& s) {
    Clusters c;
    c.at = s.at, c.vertices = s.vertex_slots();
    for (Index v = 0; v < s.vertex_slots(); ++v) c.root.push_back(v);
    for (Index f = 0; f < s.face_slots(); ++f) c.faces.push_back(f);
    return c;
}

/// The coarsest grid found, of steps by a third, whose shape is within the bound; 0 when none is.
std::uint32_t coarsest_within(const Work& s, const Judge& judge, double bound, Clustered& result) {
    const auto good = [&](std::uint32_t n) {
        const Clusters c = cluster(s, Grid(n));
        ++result.measurements;
        return !c.faces.empty() && judge.within(shape_of(s, c));
    };
    const double start = std::clamp(2 / (bound * s.scale), 2.0, double(finest));
    auto n = static_cast<std::uint32_t>(start);
    if (good(n)) {
        while (n > 1 && good(n * 3 / 4)) n = n * 3 / 4;
        return n;
    }
    while (n < finest)
        if (good(n = std::min(finest, n + n / 3 + 1))) return n;
    return 0;
}

} // namespace

Clustered run_cluster(Work& s, const Mesh& from, const Goal& goal, std::optional<double> max_error) {
    sum_quadrics(s);
    Clustered result;
    std::uint32_t n = finest_within(s, goal);
    std::optional<Judge> judge;
    if (max_error) {
        judge.emplace(from, *max_error);
        const std::uint32_t bound = coarsest_within(s, *judge, *max_error, result);
        result.by_error = bound == 0 || bound > n;
        n = bound == 0 ? 0 : std::max(n, bound);
    }
    Clusters c = n == 0 ? unclustered(s) : cluster(s, Grid(n));
    while (c.faces.empty() && s.live_faces > 0 && n < finest) c = cluster(s, Grid(++n));
    if (max_error) result.measured = judge->deviation(shape_of(s, c));
    result.cell = n == 0 ? 0 : Grid(n).edge() / s.scale;
    result.outcome.collapses = s.vertex_slots() - c.vertices, result.outcome.passes = 1;
    result.outcome.largest = c.largest;
    settle(s, c);
    result.outcome.stuck = !result.by_error && s.live_faces > goal.faces && s.live_vertices > goal.vertices;
    return result;
}

} // namespace facetmill::simplification
