#pragma once
// The sources of the elements of a new mesh. Every stage that makes elements returns a provenance, from
// which a single function derives the attributes. All mixing of attributes happens here.

#include "mesh/mesh.hpp"

namespace facetmill {

/// The elements of a domain of a new mesh, in order: first copies of old elements, then points on edges, then
/// weighted mixes of any number of old elements.
struct Provenance {
    struct Edge {
        Index a = 0, b = 0; ///< old elements
        double t = 0.5;     ///< position on the edge: 0 at a, 1 at b
    };
    bool identity = false; ///< copies is not stored, because all old elements come first, in order
    /// With identity: edges may connect elements made by earlier edges, so they are processed in order.
    bool chained = false;
    std::vector<Index> copies; ///< old index of each copied element
    std::vector<Edge> edges;   ///< edges of the elements after the copies
    std::vector<Index> mix_offsets{
        0}; ///< [mixes + 1] offsets into mix_sources, for the elements after the edges
    std::vector<Index> mix_sources;  ///< old elements
    std::vector<double> mix_weights; ///< one per source, summing to one

    std::size_t mixes() const { return mix_offsets.size() - 1; }
};

/// The sources of the three domains of a new mesh. Faces are only copies.
struct MeshProvenance {
    Provenance vertices, wedges;
    bool wedges_as_vertices = false; ///< both meshes have no seams, so wedges is not filled
    std::vector<Index> faces;    ///< old face of each new face; may be empty if old faces have no attributes
    bool faces_identity = false; ///< the faces are the same, so faces is not filled
};

/// Whether the mesh has attributes of the domain, so that a provenance is needed.
bool has_attributes(const Mesh& mesh, Domain domain);

/// Fills to.attributes and to.primitives from `from`, by the roles of the attributes. Normals and tangents
/// are renormalised. Equal joints are merged, the strongest are kept (ties by joint index), and their
/// weights are renormalised. Role::index uses the first parent's value. Integers are rounded to nearest,
/// ties up. Each value is computed once from its parents, in double precision. Parallel; the result does not
/// depend on the number of threads. Returns the change of each attribute (kept if no value was mixed).
AttributeChanges inherit_attributes(Mesh& to, const Mesh& from, const MeshProvenance& provenance);

} // namespace facetmill
