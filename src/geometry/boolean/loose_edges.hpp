#pragma once
// Face adjacency without a full edge table, because it is already known around most vertices.

#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

namespace facetmill::clean_steps {

/// Vertices whose faces form one closed ring with consistent orientation (SelfIntersections::rings).
/// [vertices], or empty if no ring is known.
using Rings = std::vector<std::uint8_t>;

/// The edges with an end that is not a ring. Every other edge has two faces with opposite directions. At a
/// ring, each neighbour is the second vertex of one face and the third of another.
class LooseEdges {
  public:
    LooseEdges() = default;
    /// Requires rings of this mesh; reversing faces does not change them.
    LooseEdges(const Mesh& mesh, const Rings& rings);

    std::size_t size() const { return offsets_.empty() ? 0 : offsets_.size() - 1; }
    /// The corners along an edge, ascending.
    std::span<const Index> corners_of(Index e) const {
        return {corners_.data() + offsets_[e], corners_.data() + offsets_[e + 1]};
    }

  private:
    std::vector<Index> offsets_, corners_;
};

/// Sets of connected faces: by common rings, and by explicit joins.
class FaceSets {
  public:
    /// Uses only flagged rings, and only faces for which takes(f) is true.
    template <class Takes>
    FaceSets(const Mesh& mesh, const Rings& rings, Takes&& takes)
        : mesh_(mesh), rings_(rings), sets_(rings.size() + mesh.face_count()) {
        parallel_for(rings.empty() ? 0 : mesh.face_count(), [&](std::size_t i) {
            const auto f = static_cast<Index>(i);
            if (!takes(f)) return;
            const Index first = element(f);
            for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
                if (const Index v = mesh.vertex(c); rings_[v] && v != first) sets_.join(first, v);
        });
    }

    void join(Index f, Index g) { sets_.join(element(f), element(g)); }
    /// A number below `bound` that is equal for all faces of a set. Call it after all joins.
    Index find(Index f) { return sets_.find(element(f)); }
    std::size_t bound() const { return rings_.size() + mesh_.face_count(); }

  private:
    /// The element that represents a face: one of its rings, or the face itself.
    Index element(Index f) const {
        if (!rings_.empty())
            for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c)
                if (const Index v = mesh_.vertex(c); rings_[v]) return v;
        return static_cast<Index>(rings_.size() + f);
    }

    const Mesh& mesh_;
    const Rings& rings_;
    DisjointSets sets_;
};

/// Like face_components(mesh, build_edges(mesh)).
[[nodiscard]] Components face_components(const Mesh& mesh, const Rings& rings, const LooseEdges& edges);

} // namespace facetmill::clean_steps
