#pragma once
// The attributes of a mesh in forms that glTF allows: names, types and values.

#include "mesh/mesh.hpp"

namespace facetmill::io::gltf {

/// An attribute of vertices or wedges, ready to be written.
struct Column {
    std::string semantic; ///< "TEXCOORD_0", "_quality"
    int target = -1;      ///< its morph target, or -1
    Attribute data;
};

struct ColumnSettings {
    bool quantised = false; ///< KHR_mesh_quantization is already used, so small integers may stay
    bool skinned = true;    ///< keep joints and weights
};

/// All columns of the mesh, in the order of its attributes. Attributes that glTF cannot store are dropped or
/// converted, which `changes` records. Face attributes and elements of 5 to 8 numbers are dropped. 64-bit
/// floats and 32-bit integers become float32 (or uint16 if they fit; identifiers too). Normals and tangents
/// get unit length again; colours and weights are clamped to the range from 0 to 1.
[[nodiscard]] std::vector<Column> columns_of(const Mesh& mesh, const ColumnSettings& settings,
                                             AttributeChanges& changes);

/// "SCALAR", "VEC3", "MAT4"; null for component counts without a glTF type.
[[nodiscard]] const char* type_name(int components);

} // namespace facetmill::io::gltf
