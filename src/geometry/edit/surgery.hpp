#pragma once
// The cuts and stitches that repairs are made of: faces that go, vertices that merge or part, points put on
// edges, patches. Each gives a new mesh in which all else is as it was, in the same order.

#include "mesh/mesh.hpp"
#include "mesh/provenance.hpp"

#include <span>
#include <vector>

namespace facetmill {

/// The mesh with only these faces, in this order. Vertices and wedges that lose their last face are removed;
/// vertices and wedges without faces stay.
[[nodiscard]] Mesh keep_faces(const Mesh& mesh, const std::vector<Index>& faces);

/// One mesh per label below count: the faces of that label in order, with the vertices and wedges that they
/// use, in order of use. Isolated vertices go. O(corners), for any number of labels.
[[nodiscard]] std::vector<Mesh> separated(const Mesh& mesh, const std::vector<Index>& label_of_face,
                                          std::size_t count);

/// The same, each mesh with a table of its own primitives, in the order of the original table. O(corners),
/// also for meshes of many primitives.
[[nodiscard]] std::vector<Mesh> separated_with_primitives(Mesh mesh, const std::vector<Index>& label_of_face,
                                                          std::size_t count);

/// The faces whose flag is zero, ascending.
[[nodiscard]] std::vector<Index> faces_without(const std::vector<std::uint8_t>& flags);

/// Vertex v becomes target[v] <= v, for which target[target[v]] == target[v]; the others keep their order.
/// Wedges stay separate when the mesh has wedge attributes. Faces are kept, also faces that lose their area.
/// Returns the number of removed vertices.
std::size_t merge_vertices(Mesh& mesh, const std::vector<Index>& target);

/// Corner c goes to vertex_of_corner[c]: its own vertex v, or a new vertex (numbered from the mesh's vertex
/// count), where new vertex i is a copy of copies[i]. Wedges follow, and are copied where their corners
/// separate.
[[nodiscard]] Mesh part_corners(const Mesh& mesh, const std::vector<Index>& vertex_of_corner,
                                const std::vector<Index>& copies);

/// A vertex to be put on the edge that starts at a corner.
struct Insertion {
    Index corner; ///< of the face; the edge runs to the next corner
    double t;     ///< where on the edge, above 0 and below 1
    Index vertex; ///< an existing vertex, or a new one: vertex count + its index in `added`
};

/// Inserts the vertices into the edges: a triangle becomes triangles, a larger face gets corners. New
/// vertices are interpolated between the ends given in added; so are wedges, once per pair of wedges and
/// vertex. `changes` receives the changes of the attributes.
Mesh insert_on_edges(const Mesh& mesh, std::vector<Insertion> insertions,
                     const std::vector<Provenance::Edge>& added, AttributeChanges* changes = nullptr);

/// Faces to be added. A corner names a wedge of the mesh, or wedge count + i for new point i.
struct Patches {
    std::vector<Vec3> points;          ///< new vertices, a wedge each
    std::vector<Index> mix_offsets{0}; ///< [points + 1] into mix_wedges: where their attributes come from
    std::vector<Index> mix_wedges;
    std::vector<double> mix_weights; ///< summing to one
    std::vector<Index> corners;
    std::vector<Index> offsets{0}; ///< [faces + 1] into corners
    std::vector<Index> sources;    ///< [faces] the face whose attributes each copies

    void add_face(std::span<const Index> wedges, Index source);
};

[[nodiscard]] Mesh with_patches(const Mesh& mesh, const Patches& patches,
                                AttributeChanges* changes = nullptr);

} // namespace facetmill
