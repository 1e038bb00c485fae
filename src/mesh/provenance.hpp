#pragma once
// The sources of the elements of a new mesh. Every stage that makes elements returns a provenance, and one
// function derives the attributes. All mixing of attributes happens here.

#include "mesh/mesh.hpp"

namespace facetmill {

/// The elements of a domain of a new mesh, in order: first copies of old elements, then points on edges, then
/// weighted mixes of any number of old elements.
struct Provenance {
    struct Edge {
        Index a = 0, b = 0; ///< old elements
        double t = 0.5;     ///< 0 at a, 1 at b
    };
    bool identity = false; ///< copies is not stored: all old elements, in order, come first
    /// With identity: edges may connect elements made by earlier edges. Processed in order.
    bool chained = false;
    std::vector<Index> copies;         ///< old index of each copied element
    std::vector<Edge> edges;           ///< the elements after the copies
    std::vector<Index> mix_offsets{0}; ///< [mixes + 1] into mix_sources; the elements after the edges
    std::vector<Index> mix_sources;    ///< old elements
    std::vector<double> mix_weights;   ///< one per source, summing to one

    std::size_t mixes() const { return mix_offsets.size() - 1; }
};

/// How the three domains of a new mesh come from an old one. Face lineage is copies only.
struct MeshProvenance {
    Provenance vertices, wedges;
    bool wedges_as_vertices = false; ///< both meshes are without seams: wedges is not filled
    std::vector<Index>
        faces; ///< old face of each new face; may stay empty when the old ones have no attributes
    bool faces_identity = false; ///< the same faces; faces is not filled
};

/// Whether the mesh has attributes of the domain, whose descent is then needed.
bool has_attributes(const Mesh& mesh, Domain domain);

/// Fills to.attributes and to.primitives from from's, by the roles of the attributes: normals and tangents
/// are renormalised; joints are united, the strongest kept and their weights renormalised (ties by joint
/// index); Role::index takes the first parent's; integers are rounded to nearest, ties up. Each value is
/// computed once, from its own parents, in double precision. Parallel; the same bytes for any number of
/// threads. Returns what became of each attribute (kept when nothing was mixed).
AttributeChanges inherit_attributes(Mesh& to, const Mesh& from, const MeshProvenance& provenance);

} // namespace facetmill
