#pragma once
// Patterns: how methods of split that cut all faces alike replace a face.

#include "geometry/split/centre.hpp"
#include "geometry/split/points.hpp"
#include "mesh/quad_diagonal.hpp"
#include "parallel/parallel.hpp"
#include "parallel/storage.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace facetmill {

/// The size of a face's replacement: new faces and corners, inner points (mixes), and sources of the mixes.
struct PatternCounts {
    std::uint64_t faces = 0, corners = 0, mixes = 0, sources = 0;

    PatternCounts& operator+=(const PatternCounts& b) {
        faces += b.faces;
        corners += b.corners;
        mixes += b.mixes;
        sources += b.sources;
        return *this;
    }
};

/// A face of the old mesh with the points on its edges and the space for its new faces.
struct PatternFace {
    const Mesh& mesh;
    const EdgePoints* points;
    Index face;
    Index first_mix; ///< wedge number of this face's first inner point

    Index size() const { return mesh.face_size(face); }
    /// The wedge of corner k.
    Index at(Index k) const { return mesh.corners[mesh.face_begin(face) + k]; }
    /// The wedge of point i on the edge from corner k, counted from corner k.
    Index on(Index k, int i = 1) const { return points->wedge(mesh.face_begin(face) + k, i); }
    Index inside(Index i) const { return first_mix + i; }
};

/// The output of a pattern, in order.
struct PatternOut {
    Index* corners;
    Index* offsets; ///< null: triangles only
    Index first_corner;
    Index* mix_offsets;
    Index* mix_sources;
    double* mix_weights;
    Index first_source;

    template <class... Wedges>
    void face(Wedges... wedges) {
        ((*corners++ = wedges), ...);
        first_corner += sizeof...(wedges);
        if (offsets) *offsets++ = first_corner;
    }
    void face_of(std::span<const Index> wedges) {
        for (const Index w : wedges) *corners++ = w;
        first_corner += static_cast<Index>(wedges.size());
        if (offsets) *offsets++ = first_corner;
    }
    void source(Index wedge, double weight) {
        *mix_sources++ = wedge;
        *mix_weights++ = weight;
        ++first_source;
    }
    void end_mix() { *mix_offsets++ = first_source; }
};

namespace split_detail {

/// Running sums of the counts before each block of faces; [blocks + 1].
constexpr std::size_t block = 2048;

template <class Pattern>
[[nodiscard]] std::vector<PatternCounts> count_blocks(const Mesh& mesh, const Pattern& pattern) {
    std::vector<PatternCounts> sums((mesh.face_count() + block - 1) / block + 1);
    parallel_chunks(
        mesh.face_count(),
        [&](std::size_t begin, std::size_t end) {
            PatternCounts sum;
            for (std::size_t f = begin; f < end; ++f) sum += pattern.counts(mesh, static_cast<Index>(f));
            sums[begin / block + 1] = sum;
        },
        block);
    for (std::size_t b = 1; b < sums.size(); ++b) sums[b] += sums[b - 1];
    return sums;
}

/// Sets positions, wedge_vertex, attributes and primitives of the result from its provenances.
[[nodiscard]] AttributeChanges finish(Mesh& to, const Mesh& from, MeshProvenance& provenance,
                                      const EdgePoints* points);

} // namespace split_detail

/// The mesh with every face replaced by its pattern. A Pattern has
///   PatternCounts counts(const Mesh&, Index face) const;
///   void emit(const PatternFace&, PatternOut&) const;   faces and mixes, as many as counted
///   bool triangles_only(const Mesh&) const;             true: all new faces are triangles
/// points may be null if the pattern uses none.
template <class Pattern>
[[nodiscard]] Mesh apply_pattern(const Mesh& mesh, const EdgePoints* points, const Pattern& pattern,
                                 AttributeChanges& changes) {
    const auto sums = split_detail::count_blocks(mesh, pattern);
    const PatternCounts& total = sums.back();
    Mesh out;
    MeshProvenance provenance;
    resize_large(out.corners, total.corners);
    const bool offsets = !pattern.triangles_only(mesh);
    if (offsets) out.face_offsets.assign(total.faces + 1, 0);
    const bool face_sources = has_attributes(mesh, Domain::face);
    if (face_sources) resize_large(provenance.faces, total.faces);
    Provenance& mixes = provenance.wedges;
    mixes.mix_offsets.assign(total.mixes + 1, 0);
    mixes.mix_sources.resize(total.sources);
    mixes.mix_weights.resize(total.sources);
    const std::size_t first_inside = mesh.wedge_count() + (points ? points->wedge_points() : 0);
    parallel_chunks(
        mesh.face_count(),
        [&](std::size_t begin, std::size_t end) {
            PatternCounts at = sums[begin / split_detail::block];
            PatternOut to{out.corners.data() + at.corners,
                          offsets ? out.face_offsets.data() + at.faces + 1 : nullptr,
                          static_cast<Index>(at.corners),
                          mixes.mix_offsets.data() + at.mixes + 1,
                          mixes.mix_sources.data() + at.sources,
                          mixes.mix_weights.data() + at.sources,
                          static_cast<Index>(at.sources)};
            for (std::size_t i = begin; i < end; ++i) {
                const Index f = static_cast<Index>(i);
                pattern.emit({mesh, points, f, static_cast<Index>(first_inside + at.mixes)}, to);
                const PatternCounts made = pattern.counts(mesh, f);
                if (face_sources) std::fill_n(&provenance.faces[at.faces], made.faces, f);
                at += made;
            }
        },
        split_detail::block);
    changes = split_detail::finish(out, mesh, provenance, points);
    normalise_offsets(out);
    return out;
}

/// Divides triangles into n * n triangles and quads into n x n quads, in rows along the first edge.
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

    /// The wedge of lattice point (i, j): i steps along the first edge, j steps towards the third corner.
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

    /// The wedge of lattice point (i, j): i steps along the first edge, j steps along the second.
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

inline void centroid(const PatternFace& face, PatternOut& out) {
    const CentreWeights weights = centre_weights(face.mesh, face.face);
    for (Index k = 0; k < face.size(); ++k) out.source(face.at(k), weights.of(k));
    out.end_mix();
}

/// Makes a triangle at every corner, and a triangle between the middles of the edges, in the order of
/// GridPattern with n = 2.
inline void four_triangles(const PatternFace& face, PatternOut& out) {
    const Index first = face.on(0), second = face.on(1), third = face.on(2);
    out.face(face.at(0), first, third);
    out.face(first, second, third);
    out.face(first, face.at(1), second);
    out.face(third, second, face.at(2));
}

/// Makes a quad at every corner, through the middles of its edges and the centroid.
struct QuadsPattern {
    bool keep_triangles = false; ///< triangles become four triangles instead

    PatternCounts counts(const Mesh& mesh, Index f) const {
        const Index n = mesh.face_size(f);
        return n == 3 && keep_triangles ? PatternCounts{4, 12, 0, 0} : PatternCounts{n, 4 * n, 1, n};
    }
    bool triangles_only(const Mesh& mesh) const { return keep_triangles && mesh.all_triangles(); }
    void emit(const PatternFace& face, PatternOut& out) const {
        const Index n = face.size();
        if (n == 3 && keep_triangles) return four_triangles(face, out);
        centroid(face, out);
        Index before = face.on(n - 1);
        for (Index k = 0; k < n; ++k) {
            const Index after = face.on(k);
            out.face(face.at(k), after, face.inside(0), before);
            before = after;
        }
    }
};

/// Makes a triangle from every edge to the centroid.
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

/// Turns faces of four corners and more into triangles around their centroid; triangles stay.
struct FanPattern {
    PatternCounts counts(const Mesh& mesh, Index f) const {
        return mesh.face_size(f) == 3 ? PatternCounts{1, 3, 0, 0} : CentroidPattern{}.counts(mesh, f);
    }
    bool triangles_only(const Mesh&) const { return true; }
    void emit(const PatternFace& face, PatternOut& out) const {
        if (face.size() == 3) return out.face(face.at(0), face.at(1), face.at(2));
        CentroidPattern{}.emit(face, out);
    }
};

/// Makes a triangle at every corner, and the polygon of the edges' middles. If another face shares both
/// edges of a corner, the corner stays in the polygon, because the edge across it would belong to both
/// faces.
struct VarignonPattern {
    const std::vector<std::uint8_t>& shared; ///< [corners] 1 if another face shares both edges

    Index kept(const Mesh& mesh, Index f) const {
        Index n = 0;
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) n += shared[c];
        return n;
    }
    PatternCounts counts(const Mesh& mesh, Index f) const {
        const Index n = mesh.face_size(f), k = kept(mesh, f);
        return {n - k + 1, 4 * n - 2 * k, 0, 0};
    }
    bool triangles_only(const Mesh& mesh) const {
        return mesh.all_triangles() && std::find(shared.begin(), shared.end(), 1) == shared.end();
    }
    void emit(const PatternFace& face, PatternOut& out) const {
        const Index n = face.size(), begin = face.mesh.face_begin(face.face);
        std::vector<Index> polygon;
        for (Index k = 0; k < n; ++k) {
            if (shared[begin + k])
                polygon.push_back(face.at(k));
            else
                out.face(face.at(k), face.on(k), face.on(k == 0 ? n - 1 : k - 1));
            polygon.push_back(face.on(k));
        }
        out.face_of(polygon);
    }
};

/// Makes the same shape at half size around the centroid, and a quad between it and every edge.
struct CorePattern {
    PatternCounts counts(const Mesh& mesh, Index f) const {
        const std::uint64_t n = mesh.face_size(f);
        return {n + 1, 5 * n, n, n * n};
    }
    bool triangles_only(const Mesh&) const { return false; }
    void emit(const PatternFace& face, PatternOut& out) const {
        const Index n = face.size();
        const CentreWeights weights = centre_weights(face.mesh, face.face);
        std::vector<Index> inner(n);
        for (Index k = 0; k < n; ++k) {
            for (Index s = 0; s < n; ++s) out.source(face.at(s), (s == k ? 0.5 : 0.0) + 0.5 * weights.of(s));
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

/// Cuts quads along a diagonal.
struct DiagonalPattern {
    const std::vector<std::uint8_t>& at_second; ///< [faces] 1: from the second corner

    PatternCounts counts(const Mesh& mesh, Index f) const {
        const Index n = mesh.face_size(f);
        return {n - 2, 3 * (n - 2), 0, 0};
    }
    bool triangles_only(const Mesh&) const { return true; }
    void emit(const PatternFace& face, PatternOut& out) const {
        if (face.size() == 3) return out.face(face.at(0), face.at(1), face.at(2));
        const Index s = at_second[face.face];
        out.face(face.at(s), face.at(s + 1), face.at(s + 2));
        out.face(face.at(s), face.at(s + 2), face.at((s + 3) % 4));
    }
};

} // namespace facetmill
