#pragma once
// The properties of an element of a PLY file as attributes of a mesh.

#include "io/ply/ply.hpp"

namespace facetmill::io::ply {

/// An element with its values; properties are taken out of it one after another.
struct Table {
    const Element* element = nullptr;
    std::vector<Column> columns;
    std::vector<bool> taken;

    std::size_t count() const { return element ? element->count : 0; }
    const Property& property(std::size_t p) const { return element->properties[p]; }

    /// The columns of these names, when all are there; they are taken then.
    std::vector<std::size_t> take(std::initializer_list<std::string_view> names, bool list = false);
};

/// Colours: bytes and 16-bit numbers as fractions, floats as they are, wider integers as the bytes they mean.
void add_colours(Table& table, Mesh& mesh, Domain domain);
void add_normals(Table& table, Mesh& mesh);
/// Texture coordinates count from the bottom in PLY, from the top in glTF's convention, which the mesh keeps.
void add_uvs(Table& table, Mesh& mesh);
/// Every scalar that is left, under its own name; "name_0", "name_1", ... of one type become one attribute.
void add_others(Table& table, Mesh& mesh, Domain domain);

} // namespace facetmill::io::ply
