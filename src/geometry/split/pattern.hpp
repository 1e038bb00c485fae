#pragma once
// The frame that all methods of split share: a pattern says what one face becomes, apply_pattern does it for
// all.

#include "base/parallel.hpp"
#include "base/storage.hpp"
#include "geometry/split/points.hpp"

#include <array>
#include <span>

namespace facetmill {

/// What one face becomes: how many new faces and corners, points inside it (mixes) and sources of those.
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

/// A face of the old mesh with the points on its edges and the room for its new ones.
struct PatternFace {
    const Mesh& mesh;
    const EdgePoints* points;
    Index face;
    Index first_mix; ///< wedge number of this face's first inner point

    Index size() const { return mesh.face_size(face); }
    /// Wedge of corner k.
    Index at(Index k) const { return mesh.corners[mesh.face_begin(face) + k]; }
    /// Wedge of point i on the edge from corner k, counted from corner k.
    Index on(Index k, int i = 1) const { return points->wedge(mesh.face_begin(face) + k, i); }
    Index inside(Index i) const { return first_mix + i; }
};

/// Where a pattern puts what it makes, in order.
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
std::vector<PatternCounts> count_blocks(const Mesh& mesh, const Pattern& pattern) {
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

/// Sets positions, wedge_vertex, attributes and primitives of the result from its lineages.
AttributeChanges finish(Mesh& to, const Mesh& from, Descent& descent, const EdgePoints* points);

} // namespace split_detail

/// The mesh with every face replaced by what the pattern makes of it. A Pattern has
///   PatternCounts counts(const Mesh&, Index face) const;
///   void emit(const PatternFace&, PatternOut&) const;   faces and mixes, as many as counted
///   bool triangles_only(const Mesh&) const;             true: no face that it makes has more than three
///   corners
/// points may be null when the pattern uses none.
template <class Pattern>
Mesh apply_pattern(const Mesh& mesh, const EdgePoints* points, const Pattern& pattern,
                   AttributeChanges& changes) {
    const auto sums = split_detail::count_blocks(mesh, pattern);
    const PatternCounts& total = sums.back();
    Mesh out;
    Descent descent;
    resize_large(out.corners, total.corners);
    const bool offsets = !pattern.triangles_only(mesh);
    if (offsets) out.face_offsets.assign(total.faces + 1, 0);
    const bool face_sources = has_attributes(mesh, Domain::face);
    if (face_sources) resize_large(descent.faces, total.faces);
    Lineage& mixes = descent.wedges;
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
                if (face_sources) std::fill_n(&descent.faces[at.faces], made.faces, f);
                at += made;
            }
        },
        split_detail::block);
    changes = split_detail::finish(out, mesh, descent, points);
    normalise_offsets(out);
    return out;
}

} // namespace facetmill
