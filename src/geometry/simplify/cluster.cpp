// The method cluster: merges the vertices in each cell of a grid, and places the result where their planes
// meet best.

#include "geometry/simplify/methods.hpp"

#include "parallel/parallel.hpp"

#include <bit>

namespace facetmill::simplification {

namespace {

constexpr std::uint32_t finest = 1u << 20; // the largest number of cells along an axis
// How strongly a representative is pulled to the mean of its vertices: enough to keep it there in a flat
// cell.
constexpr double pull_to_mean = 1e-3;

/// The vertices and faces that a grid produces.
struct Clusters {
    std::vector<Index> root;  ///< [vertices of the work] the first vertex in the same cell
    std::vector<Vec3> at;     ///< [roots] positions
    std::vector<Index> faces; ///< the faces that stay, in order
    std::size_t vertices = 0; ///< the number of nonempty cells
    double largest = 0;       ///< the largest mean squared distance to the planes of a cell
};

struct CellKey {
    std::uint64_t key;
    Index vertex;
};

/// The vertices of a cell, as a range of the sorted vertices.
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
        const double at = (x + 1) / 2 * n_; // NaN is in the first cell
        return at > 0 ? std::min(static_cast<std::uint64_t>(std::min(at, 4e9)), std::uint64_t{n_} - 1) : 0;
    }
    std::uint32_t n_;
    int bits_;
};

/// Counts faces with their vertices in three cells; some faces may coincide.
std::size_t count_faces(const State& s, const Grid& grid) {
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

/// Sorts the vertices by cell, and finds the cells.
std::vector<Cell> sort_cells(const State& s, const Grid& grid, std::vector<CellKey>& order) {
    order.resize(s.vertex_slots());
    parallel_for(order.size(), [&](std::size_t v) { order[v] = {grid.key(s.at[v]), static_cast<Index>(v)}; });
    radix_sort(
        order, [](const CellKey& k) { return k.key; }, grid.key_bits());
    std::vector<Cell> cells;
    for (std::size_t i = 0; i < order.size(); ++i)
        if (i == 0 || order[i].key != order[i - 1].key)
            cells.push_back({i, i + 1});
        else
            cells.back().end = i + 1;
    return cells;
}

/// Finds the position of a cell's vertex. Returns the error, squared.
double place_cell(const State& s, const Grid& grid, std::span<const CellKey> members, Vec3& at) {
    const Index root = members.front().vertex;
    at = s.at[root];
    if (members.size() == 1) return 0;
    Quadric q;
    Vec3 mean;
    const Vec3 from = s.at[root];
    for (const CellKey& k : members) {
        const Vec3 off = s.at[k.vertex] - from;
        q += seen_from(s.quadrics->near[k.vertex], -off);
        mean += off;
    }
    mean = mean / static_cast<double>(members.size());
    const Vec3 best = q.weight > 0 ? q.least(mean, pull_to_mean * q.weight) : mean;
    at = from + best;
    if (!grid.together(at, from)) at = is_finite(mean) ? from + mean : from;
    return q.weight > 0 ? q(at - from) / q.weight : 0;
}

/// A face by its three roots, starting with the lowest. turned: the other two are in descending order.
struct Triple {
    Index low, middle, high;
    bool turned;
    Index face;
    bool same_place(const Triple& o) const { return low == o.low && middle == o.middle && high == o.high; }
};

Triple triple_of(const State& s, const Clusters& c, Index f) {
    std::array<Index, 3> v{c.root[s.tri[3 * f]], c.root[s.tri[3 * f + 1]], c.root[s.tri[3 * f + 2]]};
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    const bool turned = v[1] > v[2];
    return {v[0], std::min(v[1], v[2]), std::max(v[1], v[2]), turned, f};
}

/// Keeps one of several faces with the same vertices: the first that faces to the majority's side. Without a
/// majority, keeps a face for each side.
void keep_some(std::span<const Triple> same, std::vector<Index>& faces) {
    const auto turned = std::count_if(same.begin(), same.end(), [](const Triple& t) { return t.turned; });
    const auto other = static_cast<std::ptrdiff_t>(same.size()) - turned;
    const auto first = [&](bool side) {
        faces.push_back(
            std::find_if(same.begin(), same.end(), [&](const Triple& t) { return t.turned == side; })->face);
    };
    if (turned >= other) first(true);
    if (other >= turned) first(false);
}

/// Finds the faces that stay because they have three roots. Among coincident faces, at most one stays for
/// each side.
void keep_faces(const State& s, Clusters& c) {
    std::vector<Triple> triples;
    for (Index f = 0; f < s.face_slots(); ++f) {
        const Index x = c.root[s.tri[3 * f]], y = c.root[s.tri[3 * f + 1]], z = c.root[s.tri[3 * f + 2]];
        if (x != y && y != z && z != x) triples.push_back(triple_of(s, c, f));
    }
    const int bits = std::bit_width(s.vertex_slots());
    radix_sort( // stable: faces with equal roots stay in order
        triples, [](const Triple& t) { return t.high; }, bits);
    radix_sort(
        triples, [](const Triple& t) { return (std::uint64_t{t.low} << 32) | t.middle; }, 32 + bits);
    for (std::size_t begin = 0, end = 0; begin < triples.size(); begin = end) {
        while (end < triples.size() && triples[end].same_place(triples[begin])) ++end;
        keep_some({&triples[begin], end - begin}, c.faces);
    }
    std::sort(c.faces.begin(), c.faces.end());
}

Clusters cluster(const State& s, const Grid& grid) {
    Clusters c;
    std::vector<CellKey> order;
    const auto cells = sort_cells(s, grid, order);
    c.vertices = cells.size();
    c.root.resize(s.vertex_slots());
    c.at.resize(s.vertex_slots());
    c.largest = parallel_reduce(
        cells.size(), 0.0,
        [&](std::size_t begin, std::size_t end) {
            double largest = 0;
            for (std::size_t i = begin; i < end; ++i) {
                const std::span<const CellKey> members(&order[cells[i].begin], cells[i].end - cells[i].begin);
                const Index root = members.front().vertex;
                for (const CellKey& k : members) c.root[k.vertex] = root;
                largest = std::max(largest, place_cell(s, grid, members, c.at[root]));
            }
            return largest;
        },
        [](double a, double b) { return std::max(a, b); });
    keep_faces(s, c);
    return c;
}

/// Finds an element's root in a forest, and shortens the path.
Index find(std::vector<Index>& parent, Index e) {
    while (parent[e] != e) e = parent[e] = parent[parent[e]];
    return e;
}

/// Merges wedges that faces connect within a cell; different islands of a texture stay separate.
std::vector<Index> join_wedges(const State& s, const Clusters& c) {
    std::vector<Index> parent(
        s.has_seams() ? *std::max_element(s.wedge.begin(), s.wedge.end()) + std::size_t{1} : 0);
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

/// The clusters as a shape; adds the merges to `log`.
Shape shape_of(const State& s, const Clusters& c, std::optional<Log>& log) {
    const std::vector<Index> wedges = join_wedges(s, c);
    Shape shape{.frame = s.frame, .at = s.at, .source = s.source, .moved = s.moved};
    for (Index v = 0; v < s.vertex_slots(); ++v) {
        const Index root = c.root[v];
        if (root == v) continue;
        shape.moved[root] = 1;
        shape.at[root] = c.at[root];
        if (log) log->steps.push_back({s.source[root], s.source[v], 0, 0, c.at[root]});
    }
    for (Index w = 0; w < wedges.size(); ++w)
        if (log && wedges[w] != w) log->wedges.push_back({wedges[w], w});
    for (const Index f : c.faces) {
        shape.face_source.push_back(s.face_source[f]);
        for (std::size_t k = 0; k < 3; ++k) {
            shape.tri.push_back(c.root[s.tri[3 * f + k]]);
            if (s.has_seams()) shape.wedge.push_back(wedges[s.wedge[3 * f + k]]);
        }
    }
    drop_unused(shape);
    return shape;
}

/// Positions and faces only.
Mesh bare_mesh(const State& s, const Clusters& c) {
    Mesh mesh;
    mesh.positions.resize(s.vertex_slots());
    parallel_for(mesh.positions.size(), [&](std::size_t v) {
        mesh.positions[v] = s.frame.outside(c.root[v] == v ? c.at[v] : s.at[v]);
    });
    for (const Index f : c.faces)
        for (std::size_t k = 0; k < 3; ++k) mesh.corners.push_back(c.root[s.tri[3 * f + k]]);
    drop_unused(mesh);
    return mesh;
}

/// The finest grid found whose count does not exceed a limit. Counts grow with the square of the cells along
/// an axis, which guides the search.
template <class Count>
std::uint32_t finest_within(const State& s, std::size_t most, Count&& count) {
    if (most == 0) return 1;
    std::uint32_t good = 1, bad = finest + 1;
    double guess = std::sqrt(static_cast<double>(s.rings.live_faces)) * 0.25;
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

/// The finest grid that meets either the face or the vertex goal.
std::uint32_t finest_within(const State& s, const Goal& goal) {
    std::vector<CellKey> order;
    return std::max(
        finest_within(s, goal.faces, [&](const Grid& grid) { return count_faces(s, grid); }),
        finest_within(s, goal.vertices, [&](const Grid& grid) { return sort_cells(s, grid, order).size(); }));
}

/// No clusters: every vertex is its own root.
Clusters unclustered(const State& s) {
    Clusters c;
    c.at = s.at;
    c.vertices = s.vertex_slots();
    for (Index v = 0; v < s.vertex_slots(); ++v) c.root.push_back(v);
    for (Index f = 0; f < s.face_slots(); ++f) c.faces.push_back(f);
    return c;
}

/// The coarsest grid whose shape is within the bound, found in steps of a third; 0 if no grid is.
std::uint32_t coarsest_within(const State& s, const Judge& judge, double bound, Ended& end) {
    const auto good = [&](std::uint32_t n) {
        const Clusters c = cluster(s, Grid(n));
        ++end.measurements;
        return !c.faces.empty() && judge.within(bare_mesh(s, c));
    };
    const double start = std::clamp(2 / (bound * s.frame.scale), 2.0, double(finest));
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

Ended run_cluster(State s, const Mesh& from, const Goal& goal, std::optional<double> max_error,
                  std::size_t samples) {
    s.quadrics = {.near = vertex_quadrics(s), .fine = {}, .attributes = {}};
    Ended end;
    std::uint32_t n = finest_within(s, goal);
    std::optional<Judge> judge;
    if (max_error) {
        judge.emplace(from, *max_error, samples);
        const std::uint32_t bound = coarsest_within(s, *judge, *max_error, end);
        end.by_error = bound == 0 || bound > n;
        n = bound == 0 ? 0 : std::max(n, bound);
    }
    Clusters c = n == 0 ? unclustered(s) : cluster(s, Grid(n));
    while (c.faces.empty() && s.rings.live_faces > 0 && n < finest) c = cluster(s, Grid(++n));
    if (max_error) end.measured = judge->deviation(bare_mesh(s, c));
    end.cell = n == 0 ? 0 : Grid(n).edge() / s.frame.scale;
    end.log = std::move(s.log);
    end.shape = shape_of(s, c, end.log);
    end.outcome = {.passes = 1,
                   .collapses = s.vertex_slots() - c.vertices,
                   .largest = c.largest,
                   .stuck = !end.by_error && !goal.met(end.shape)};
    return end;
}

} // namespace facetmill::simplification
