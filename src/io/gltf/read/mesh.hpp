#pragma once
// A glTF mesh as a Mesh: its primitives merged for geometry, and known again by the face attribute
// "primitive".

#include "io/codec.hpp"
#include "io/gltf/document/accessor.hpp"

namespace facetmill::io::gltf {

/// Primitives that others read, so that no warning is due.
struct ReadElsewhere {
    bool lines = false, points = false;
};

struct DecodedMesh {
    Mesh mesh;
    std::vector<ReadWarning> warnings;
};

/// Decodes the triangles of mesh `index`, or the lines of one that has no triangles: triangles are welded by
/// exact position into vertices, or as EXT_mesh_manifold says; glTF's vertices become wedges, equal ones at a
/// vertex one wedge. Points beside them are left to the document, with a warning
/// (W-SKIPPED). Primitive::material is the document's material index. The same bytes give the same Mesh, so
/// the writer decodes again to see whether a part is untouched. Throws malformed and limit.
DecodedMesh decode_mesh(Source& source, std::size_t index, std::size_t max_vertices = none,
                        const ReadElsewhere& elsewhere = {});

/// The role that a glTF attribute name has.
Role role_of(std::string_view semantic);

/// Applies EXT_mesh_manifold's merges to a mesh whose wedges are vertices; false when there are none, or they
/// contradict the mesh (then a warning is added and nothing changed).
bool merge_as_told(Source& source, const JsonCursor& mesh_place, Mesh& mesh,
                   std::vector<ReadWarning>& warnings);

} // namespace facetmill::io::gltf
