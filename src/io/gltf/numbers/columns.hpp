#pragma once
// The attributes of a mesh as glTF can hold them: names, types and values that the standard allows.

#include "mesh/mesh.hpp"

namespace facetmill::io::gltf {

/// An attribute ready to be written: of the vertex or the wedge domain.
struct Column {
    std::string semantic; ///< "TEXCOORD_0", "_quality"
    int target = -1;      ///< the morph target it belongs to, or -1
    Attribute data;
};

struct ColumnSettings {
    bool quantised = false; ///< KHR_mesh_quantization is there already: small integers may stay
    bool skinned = true;    ///< keep joints and weights
};

/// All columns of the mesh, in its order of attributes. What glTF cannot hold is dropped or converted, and
/// said: face attributes and elements of 5 to 8 numbers are dropped; 64-bit floats and 32-bit integers become
/// float32 (or uint16 when they fit, as do identifiers). Normals and tangents get unit length again, colours
/// and weights the range from 0 to 1.
std::vector<Column> columns_of(const Mesh& mesh, const ColumnSettings& settings, AttributeChanges& changes);

/// "SCALAR", "VEC3", "MAT4"; null for numbers of components that glTF has no type for.
const char* type_name(int components);

} // namespace facetmill::io::gltf
