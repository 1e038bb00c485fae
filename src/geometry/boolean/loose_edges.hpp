#pragma once
// Where faces hang together, without a table of all edges: around most vertices that is known beforehand.

#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

namespace facetmill::clean_steps {

/// Vertices around which the faces are one closed ring that runs the same way all round
/// (SelfIntersections::rings): [vertices], or empty where it is not known of any.
using Rings = std::vector<std::uint8_t>;

/// The edges with an end that is no ring. All others have two faces, which run along them both ways: at the
/// end that is a ring each vertex beside it is the second of one face and the third of another.
class LooseEdges {
  public:
    LooseEdges() = default;
    /// Requires rings of this mesh; they are left as they are when faces are turned over.
    LooseEdges(const Mesh& mesh, const Rings& rings);

    std::size_t size() const { return offsets_.empty() ? 0 : offsets_.size() - 1; }
    /// The corners along an edge, ascending.
    std::span<const Index> corners_of(Index e) const {
        return {corners_.data() + offsets_[e], corners_.data() + offsets_[e + 1]};
    }

  private:
    std::vector<Index> offsets_, corners_;
};

/// Faces in sets of those that hang together: by the rings that they share, and by what else is joined.
class FaceSets {
  public:
    /// Only rings that are flagged join their faces, and only those faces for which takes(f).
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
    /// The same for faces of one set, below `bound`, once all joins are done.
    Index find(Index f) { return sets_.find(element(f)); }
    std::size_t bound() const { return rings_.size() + mesh_.face_count(); }

  private:
    /// What stands for a face: a ring of its own, or the face itself.
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

/// As face_components(mesh, build_edges(mesh)).
Components face_components(const Mesh& mesh, const Rings& rings, const LooseEdges& edges);

} // namespace facetmill::clean_steps
