#include "geometry/split.hpp"

#include "base/error.hpp"
#include "geometry/split_pattern.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

constexpr double corner_limit = 2147483648.0; ///< 2^31

/// Triangles into n * n triangles, quads into n x n quads, rows along the first edge.
struct GridPattern {
    int n;

    PatternCounts counts(const Mesh& mesh, Index f) const {
        const std::uint64_t m = static_cast<std::uint64_t>(n);
        if (mesh.face_size(f) == 4) return {m * m, 4 * m * m, (m - 1) * (m - 1), 4 * (m - 1) * (m - 1)};
        const std::uint64_t inner = m < 3 ? 0 : (m - 1) * (m - 2) / 2;
        return {m * m, 3 * m * m, inner, 3 * inner};
    }
    bool triangles_only(const Mesh& mesh) const { return mesh.all_triangles(); }

    void emit(const PatternFace& face, PatternOut& out) const {
        face.size() == 4 ? quad(face, out) : triangle(face, out);
    }

    /// Lattice point (i, j): i steps along the first edge, j towards the third corner.
    Index triangle_point(const PatternFace& face, int i, int j) const {
        if (j == 0) return i == 0 ? face.at(0) : i == n ? face.at(1) : face.on(0, i);
        if (i == 0) return j == n ? face.at(2) : face.on(2, n - j);
        if (i + j == n) return face.on(1, j);
        const int before = (j - 1) * (n - 1) - (j - 1) * j / 2; // inner points in lower rows
        return face.inside(static_cast<Index>(before + i - 1));
    }
    void triangle(const PatternFace& face, PatternOut& out) const {
        for (int j = 1; j < n - 1; ++j)
            for (int i = 1; i + j < n; ++i) {
                out.source(face.at(0), static_cast<double>(n - i - j) / n);
                out.source(face.at(1), static_cast<double>(i) / n);
                out.source(face.at(2), static_cast<double>(j) / n);
                out.end_mix();
            }
        for (int j = 0; j < n; ++j) {
            Index low = triangle_point(face, 0, j), high = triangle_point(face, 0, j + 1);
            for (int i = 0; i + j < n; ++i) {
                const Index next = triangle_point(face, i + 1, j);
                out.face(low, next, high);
                if (i + j + 1 < n) {
                    const Index next_high = triangle_point(face, i + 1, j + 1);
                    out.face(next, next_high, high);
                    high = next_high;
                }
                low = next;
            }
        }
    }

    /// Lattice point (i, j): i steps along the first edge, j along the second.
    Index quad_point(const PatternFace& face, int i, int j) const {
        if (j == 0) return i == 0 ? face.at(0) : i == n ? face.at(1) : face.on(0, i);
        if (j == n) return i == n ? face.at(2) : i == 0 ? face.at(3) : face.on(2, n - i);
        if (i == n) return face.on(1, j);
        if (i == 0) return face.on(3, n - j);
        return face.inside(static_cast<Index>((j - 1) * (n - 1) + i - 1));
    }
    void quad(const PatternFace& face, PatternOut& out) const {
        const double nn = static_cast<double>(n) * n;
        for (int j = 1; j < n; ++j)
            for (int i = 1; i < n; ++i) {
                out.source(face.at(0), static_cast<double>(n - i) * (n - j) / nn);
                out.source(face.at(1), static_cast<double>(i) * (n - j) / nn);
                out.source(face.at(2), static_cast<double>(i) * j / nn);
                out.source(face.at(3), static_cast<double>(n - i) * j / nn);
                out.end_mix();
            }
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                out.face(quad_point(face, i, j), quad_point(face, i + 1, j), quad_point(face, i + 1, j + 1),
                         quad_point(face, i, j + 1));
    }
};

void centroid(const PatternFace& face, PatternOut& out) {
    const Index n = face.size();
    for (Index k = 0; k < n; ++k) out.source(face.at(k), 1.0 / n);
    out.end_mix();
}

/// A quad at every corner, through the middles of its edges and the centroid.
struct QuadsPattern {
    bool keep_triangles = false; ///< triangles become four triangles instead

    PatternCounts counts(const Mesh& mesh, Index f) const {
        const Index n = mesh.face_size(f);
        return n == 3 && keep_triangles ? PatternCounts{4, 12, 0, 0} : PatternCounts{n, 4 * n, 1, n};
    }
    bool triangles_only(const Mesh& mesh) const { return keep_triangles && mesh.all_triangles(); }
    void emit(const PatternFace& face, PatternOut& out) const {
        const Index n = face.size();
        if (n == 3 && keep_triangles) return GridPattern{2}.triangle(face, out);
        centroid(face, out);
        Index before = face.on(n - 1);
        for (Index k = 0; k < n; ++k) {
            const Index after = face.on(k);
            out.face(face.at(k), after, face.inside(0), before);
            before = after;
        }
    }
};

/// A triangle on every edge, to the centroid.
struct CentroidPattern {
    PatternCounts counts(const Mesh& mesh, Index f) const {
        const Index n = mesh.face_size(f);
        return {n, 3 * n, 1, n};
    }
    bool triangles_only(const Mesh&) const { return true; }
    void emit(const PatternFace& face, PatternOut& out) const {
        centroid(face, out);
        const Index n = face.size();
        for (Index k = 0; k < n; ++k) out.face(face.at(k), face.at(k + 1 == n ? 0 : k + 1), face.inside(0));
    }
};

/// A triangle at every corner, and the polygon of the edges' middles.
struct VarignonPattern {
    PatternCounts counts(const Mesh& mesh, Index f) const {
        const Index n = mesh.face_size(f);
        return {n + 1, 4 * n, 0, 0};
    }
    bool triangles_only(const Mesh& mesh) const { return mesh.all_triangles(); }
    void emit(const PatternFace& face, PatternOut& out) const {
        const Index n = face.size();
        std::vector<Index> middles(n);
        for (Index k = 0; k < n; ++k) middles[k] = face.on(k);
        for (Index k = 0; k < n; ++k) out.face(face.at(k), middles[k], middles[k == 0 ? n - 1 : k - 1]);
        out.face_of(middles);
    }
};

/// The same shape at half size around the centroid, and a quad between it and every edge.
struct CorePattern {
    PatternCounts counts(const Mesh& mesh, Index f) const {
        const std::uint64_t n = mesh.face_size(f);
        return {n + 1, 5 * n, n, n * n};
    }
    bool triangles_only(const Mesh&) const { return false; }
    void emit(const PatternFace& face, PatternOut& out) const {
        const Index n = face.size();
        std::vector<Index> inner(n);
        for (Index k = 0; k < n; ++k) {
            for (Index s = 0; s < n; ++s) out.source(face.at(s), (s == k ? 0.5 : 0.0) + 0.5 / n);
            out.end_mix();
            inner[k] = face.inside(k);
        }
        for (Index k = 0; k < n; ++k) {
            const Index next = k + 1 == n ? 0 : k + 1;
            out.face(face.at(k), face.at(next), inner[next], inner[k]);
        }
        out.face_of(inner);
    }
};

/// Quads along their shorter diagonal (ties: the one at the first corner).
struct DiagonalPattern {
    PatternCounts counts(const Mesh& mesh, Index f) const {
        const Index n = mesh.face_size(f);
        return {n - 2, 3 * (n - 2), 0, 0};
    }
    bool triangles_only(const Mesh&) const { return true; }
    void emit(const PatternFace& face, PatternOut& out) const {
        if (face.size() == 3) return out.face(face.at(0), face.at(1), face.at(2));
        const Index c = face.mesh.face_begin(face.face);
        const auto squared = [&](Index a, Index b) {
            const Vec3 d = face.mesh.point(c + a) - face.mesh.point(c + b);
            return dot(d, d);
        };
        const Index s = squared(0, 2) <= squared(1, 3) ? 0 : 1;
        out.face(face.at(s), face.at(s + 1), face.at(s + 2));
        out.face(face.at(s), face.at(s + 2), face.at((s + 3) % 4));
    }
};

/// Triangles cut at their marked edges: across the longest first, then the halves across theirs.
struct BisectPattern {
    const EdgeTable& table;
    const std::vector<std::uint8_t>& marks;
    const std::vector<std::uint8_t>& longest; ///< [faces] local number of the longest edge, 3: none

    bool marked(Index c) const { return table.corner_edge[c] != none && marks[table.corner_edge[c]]; }
    PatternCounts counts(const Mesh&, Index f) const {
        std::uint64_t n = 1;
        for (Index c = 3 * f; c < 3 * f + 3; ++c) n += marked(c);
        return {n, 3 * n, 0, 0};
    }
    bool triangles_only(const Mesh&) const { return true; }
    void emit(const PatternFace& face, PatternOut& out) const {
        const Index k = longest[face.face];
        if (k == 3) return out.face(face.at(0), face.at(1), face.at(2));
        const Index l = (k + 1) % 3, m = (k + 2) % 3, c = 3 * face.face;
        const Index a = face.at(k), b = face.at(l), apex = face.at(m), middle = face.on(k);
        if (marked(c + m)) {
            out.face(a, middle, face.on(m));
            out.face(middle, apex, face.on(m));
        } else {
            out.face(a, middle, apex);
        }
        if (marked(c + l)) {
            out.face(middle, b, face.on(l));
            out.face(middle, face.on(l), apex);
        } else {
            out.face(middle, b, apex);
        }
    }
};

/// The local number of the longest edge of each triangle. Lengths are computed from the edge's low vertex, so
/// both faces at an edge find the same; ties go to the lower edge.
std::vector<std::uint8_t> longest_edges(const Mesh& mesh, const EdgeTable& table) {
    std::vector<std::uint8_t> longest(mesh.face_count());
    parallel_for(mesh.face_count(), [&](std::size_t f) {
        double best = -1;
        Index best_edge = none;
        std::uint8_t found = 3;
        for (std::uint8_t k = 0; k < 3; ++k) {
            const Index e = table.corner_edge[3 * f + k];
            if (e == none) continue;
            const Vec3 d = mesh.positions[table.edges[e].high] - mesh.positions[table.edges[e].low];
            const double squared = dot(d, d);
            if (squared > best || (squared == best && e < best_edge))
                best = squared, best_edge = e, found = k;
        }
        longest[f] = found;
    });
    return longest;
}

Mesh bisected(const Mesh& mesh, Fates& fates) {
    const EdgeTable table = build_edges(mesh);
    const auto longest = longest_edges(mesh, table);
    std::vector<std::uint8_t> marks(table.size());
    for (std::size_t f = 0; f < longest.size(); ++f)
        if (longest[f] < 3) marks[table.corner_edge[3 * f + longest[f]]] = 1;
    const EdgePoints points(mesh, table, 2, marks);
    return apply_pattern(mesh, &points, BisectPattern{table, marks, longest}, fates);
}

/// The most corners of a face that the method knows; 0: any.
Index most_corners(SplitMethod method) {
    switch (method) {
    case SplitMethod::grid:
    case SplitMethod::diagonal:
        return 4;
    case SplitMethod::bisect:
        return 3;
    default:
        return 0;
    }
}

const char* spelled(SplitMethod method) {
    return method == SplitMethod::grid ? "grid" : method == SplitMethod::diagonal ? "diagonal" : "bisect";
}

void check_polygons(const Mesh& mesh, SplitMethod method) {
    const Index most = most_corners(method);
    if (most == 0 || mesh.all_triangles()) return;
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (mesh.face_size(f) > most)
            throw Error(ErrorKind::stage, "E-POLYGON",
                        fmt::format("split: {} takes faces of at most {} corners, face {} has {}",
                                    spelled(method), most, f, mesh.face_size(f)),
                        most == 4 ? "'split: quads' before it makes quads of every face"
                                  : "'split: centroid' before it makes triangles of every face");
}

Mesh split_once(const Mesh& mesh, const SplitSettings& settings, Fates& fates) {
    check_polygons(mesh, settings.method);
    const auto with_points = [&](int pieces, const auto& pattern) {
        const EdgeTable table = build_edges(mesh);
        const EdgePoints points(mesh, table, pieces);
        return apply_pattern(mesh, &points, pattern, fates);
    };
    switch (settings.method) {
    case SplitMethod::midpoint:
        return with_points(2, QuadsPattern{true});
    case SplitMethod::quads:
        return with_points(2, QuadsPattern{false});
    case SplitMethod::varignon:
        return with_points(2, VarignonPattern{});
    case SplitMethod::grid:
        return with_points(settings.grid, GridPattern{settings.grid});
    case SplitMethod::bisect:
        return bisected(mesh, fates);
    case SplitMethod::centroid:
        return apply_pattern(mesh, nullptr, CentroidPattern{}, fates);
    case SplitMethod::core:
        return apply_pattern(mesh, nullptr, CorePattern{}, fates);
    case SplitMethod::diagonal:
        return apply_pattern(mesh, nullptr, DiagonalPattern{}, fates);
    }
    throw Error(ErrorKind::bug, "E-BUG", "split: unknown method");
}

/// How the numbers of triangles, quads and larger faces, and the corners of these, change in one pass.
struct Census {
    double triangles = 0, quads = 0, larger = 0, larger_corners = 0;

    double corners() const { return 3 * triangles + 4 * quads + larger_corners; }
    Census after(SplitMethod method, double n) const {
        switch (method) {
        case SplitMethod::midpoint:
            return {4 * triangles, 4 * quads + larger_corners, 0, 0};
        case SplitMethod::quads:
            return {0, corners(), 0, 0};
        case SplitMethod::bisect:
            return {4 * triangles, quads, larger, larger_corners};
        case SplitMethod::centroid:
            return {corners(), 0, 0, 0};
        case SplitMethod::grid:
            return {n * n * triangles, n * n * quads, larger, larger_corners};
        case SplitMethod::varignon:
            return {triangles + corners(), quads, larger, larger_corners};
        case SplitMethod::core:
            return {triangles, quads + corners(), larger, larger_corners};
        case SplitMethod::diagonal:
            return {triangles + 2 * quads, 0, larger, larger_corners};
        }
        return *this;
    }
};

} // namespace

double split_corner_estimate(const Mesh& mesh, const SplitSettings& settings) {
    Census census;
    if (mesh.all_triangles()) {
        census.triangles = static_cast<double>(mesh.face_count());
    } else {
        for (Index f = 0; f < mesh.face_count(); ++f) {
            const Index n = mesh.face_size(f);
            if (n == 3)
                ++census.triangles;
            else if (n == 4)
                ++census.quads;
            else
                ++census.larger, census.larger_corners += n;
        }
    }
    for (int pass = 0; pass < settings.passes && census.corners() <= 1e18; ++pass)
        census = census.after(settings.method, settings.grid);
    return census.corners();
}

SplitResult split(const Mesh& mesh, const SplitSettings& settings) {
    const double corners = split_corner_estimate(mesh, settings);
    if (corners > corner_limit)
        throw Error(
            ErrorKind::limit, "E-LIMIT",
            fmt::format("split: the result would have about {:.3g} corners, at most {:.0f} are possible",
                        corners, corner_limit),
            "use fewer passes or a coarser grid");
    SplitResult result;
    const Mesh* from = &mesh;
    for (int pass = 0; pass < settings.passes; ++pass) {
        Mesh next = split_once(*from, settings, result.fates);
        result.mesh = std::move(next);
        from = &result.mesh;
    }
    if (settings.passes <= 0) result.mesh = mesh;
    result.added = result.mesh.face_count() - mesh.face_count();
    return result;
}

SplitResult grid_split(const Mesh& mesh, int n) { return split(mesh, {SplitMethod::grid, 1, n}); }

} // namespace facetmill
