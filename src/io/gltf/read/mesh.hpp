#pragma once
// Decodes a glTF mesh as a Mesh. The geometry of its primitives is merged; the face attribute "primitive"
// keeps them apart.

#include "io/codec.hpp"
#include "io/gltf/document/accessor.hpp"

namespace facetmill::io::gltf {

struct DecodedMesh {
    Mesh mesh;
    std::vector<ReadWarning> warnings;
};

/// Decodes the triangles of mesh `index`, or the lines of a mesh without triangles, or else its first
/// primitive of points. Triangles are welded into vertices by exact position, or as EXT_mesh_manifold
/// defines. glTF's vertices become wedges; equal wedges at a vertex are merged. Primitives without positions
/// stay in the document, with a warning (W-SKIPPED).
/// Primitive::material is the document's material index. The same bytes give the same Mesh, so the writer can
/// decode again to check for changes. Throws malformed and limit.
[[nodiscard]] DecodedMesh decode_mesh(Source& source, std::size_t index, std::size_t max_vertices = none);

/// The role of a glTF attribute name.
[[nodiscard]] Role role_of(std::string_view semantic);

/// Applies EXT_mesh_manifold's merges to a mesh whose wedges are vertices. Returns false without merges, or
/// if they contradict the mesh (then it adds a warning and changes nothing).
bool merge_as_told(Source& source, const JsonCursor& mesh_place, Mesh& mesh,
                   std::vector<ReadWarning>& warnings);

} // namespace facetmill::io::gltf
