#pragma once
// The properties of a PLY element as attributes of a mesh.

#include "io/ply/ply.hpp"

#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

namespace facetmill::io::ply {

/// An element with its values. Readers take properties out of it one by one.
struct Table {
    const Element* element = nullptr;
    std::vector<Column> columns;
    std::vector<bool> taken;

    std::size_t count() const { return element ? element->count : 0; }
    const Property& property(std::size_t p) const { return element->properties[p]; }

    /// Takes out the columns with these names, if all exist.
    std::vector<std::size_t> take(std::initializer_list<std::string_view> names, bool list = false);
};

/// The property names of vertices' texture coordinates.
inline constexpr std::pair<const char*, const char*> texture_points[] = {
    {"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};

/// Adds colours as COLOR_0 (3 or 4 components). Integers become fractions of 16 bits if all columns have 16
/// bits or a value needs them, otherwise of 8 bits. Floats up to 255 or 65535 become fractions of these,
/// unless they are fractions already.
void add_colours(Table& table, Mesh& mesh, Domain domain, bool are_fractions);
/// Adds nx, ny and nz as NORMAL.
void add_normals(Table& table, Mesh& mesh);
/// Adds the first existing pair of `texture_points` as TEXCOORD_0, with v from the top as in glTF.
void add_uvs(Table& table, Mesh& mesh);
/// Adds each remaining property, except lists, as an attribute of the same name and type. NAME_0, NAME_1 and
/// so on of the same type become the components of NAME.
void add_others(Table& table, Mesh& mesh, Domain domain);

} // namespace facetmill::io::ply
