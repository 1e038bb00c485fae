#pragma once
// The properties of a PLY element as attributes of a mesh.

#include "io/ply/ply.hpp"

#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

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

/// Names of texture coordinates of vertices.
inline constexpr std::pair<const char*, const char*> texture_points[] = {
    {"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};

/// Colours as COLOR_0 (of 3 or 4 components): integers as fractions of their type's largest value, of 16 bits
/// where all are, else of 8; floats as they are.
void add_colours(Table& table, Mesh& mesh, Domain domain);
/// nx, ny and nz as NORMAL.
void add_normals(Table& table, Mesh& mesh);
/// The first pair of `texture_points` that is there as TEXCOORD_0, v from the top as in glTF.
void add_uvs(Table& table, Mesh& mesh);
/// Each property that is left, but lists, as an attribute of its own name and type; NAME_0, NAME_1 and so on,
/// of one type, as the components of NAME.
void add_others(Table& table, Mesh& mesh, Domain domain);

} // namespace facetmill::io::ply
