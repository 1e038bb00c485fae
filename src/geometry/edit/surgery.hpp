#pragma once
// Basic operations for repairs: removing faces, merging and separating vertices, inserting points on edges,
// adding patches. Each makes a new mesh in which all other elements stay unchanged, in the same order.

#include "mesh/mesh.hpp"
#include "mesh/provenance.hpp"

#include <span>
#include <vector>

namespace facetmill {

/// The mesh with only these faces, in this order. Vertices and wedges that lose their last face are removed;
/// vertices and wedges without faces stay.
[[nodiscard]] Mesh keep_faces(const Mesh& mesh, const std::vector<Index>& faces);

/// A mesh for each label below count: the faces with this label in order, with their vertices and wedges in
/// order of use. Isolated vertices are removed. O(corners), for any number of labels.
[[nodiscard]] std::vector<Mesh> separated(const Mesh& mesh, const std::vector<Index>& label_of_face,
                                          std::size_t count);

/// Like separated, but each mesh lists only the primitives that it uses, in their original order.
/// O(corners), even for many primitives.
[[nodiscard]] std::vector<Mesh> separated_with_primitives(Mesh mesh, const std::vector<Index>& label_of_face,
                                                          std::size_t count);

/// The faces whose flag is zero, ascending.
[[nodiscard]] std::vector<Index> faces_without(const std::vector<std::uint8_t>& flags);

/// Vertex v becomes target[v] <= v, for which target[target[v]] == target[v]; the others keep their order.
/// Wedges stay separate when the mesh has wedge attributes. All faces stay, even if they lose their area.
/// Returns the number of removed vertices.
std::size_t merge_vertices(Mesh& mesh, const std::vector<Index>& target);

/// Corner c goes to vertex_of_corner[c]: its own vertex v, or a new vertex (numbered from the mesh's vertex
/// count), where new vertex i is a copy of copies[i]. Wedges follow, and are copied where their corners
/// separate.
[[nodiscard]] Mesh part_corners(const Mesh& mesh, const std::vector<Index>& vertex_of_corner,
                                const std::vector<Index>& copies);

/// A vertex to be put on the edge that starts at a corner.
struct Insertion {
    Index corner; ///< corner of the face; the edge runs to the next corner
    double t;     ///< position on the edge, above 0 and below 1
    Index vertex; ///< an existing vertex, or a new one: vertex count + its index in `added`
};

/// Inserts the vertices into the edges: a triangle becomes triangles, a larger face gets corners. New
/// vertices are interpolated between the ends given in `added`. Wedges are interpolated once per vertex and
/// pair of wedges. `changes` receives the changes of the attributes.
Mesh insert_on_edges(const Mesh& mesh, std::vector<Insertion> insertions,
                     const std::vector<Provenance::Edge>& added, AttributeChanges* changes = nullptr);

/// Faces to add. A corner is a wedge of the mesh, or the wedge count + i for new point i.
struct Patches {
    std::vector<Vec3> points;          ///< new vertices, each with a wedge
    std::vector<Index> mix_offsets{0}; ///< [points + 1] offsets into mix_wedges, the sources of attributes
    std::vector<Index> mix_wedges;
    std::vector<double> mix_weights; ///< weights that sum to one per point
    std::vector<Index> corners;
    std::vector<Index> offsets{0}; ///< [faces + 1] offsets into corners
    std::vector<Index> sources;    ///< [faces] the face whose attributes each copies

    void add_face(std::span<const Index> wedges, Index source);
};

[[nodiscard]] Mesh with_patches(const Mesh& mesh, const Patches& patches,
                                AttributeChanges* changes = nullptr);

} // namespace facetmill
