#pragma once
// A Mesh as glTF primitives: split by primitive, with wedges as glTF vertices, plain or compressed with
// Draco.

#include "io/codec.hpp"
#include "io/gltf/document/builder.hpp"
#include "io/gltf/numbers/columns.hpp"

namespace facetmill::io::gltf {

/// Buffer view targets of glTF.
inline constexpr int array_buffer = 34962, element_buffer = 34963;

struct EncodeSettings {
    DracoSettings draco;
    Lattice lattice{};                         ///< of positions under Draco; without a step: of the mesh
    QuantizeSettings quantize;                 ///< later rounding of attributes
    bool filters = false;                      ///< rounding will use meshopt's filters
    bool manifold = false;                     ///< write EXT_mesh_manifold
    TriangleOrder order = TriangleOrder::keep; ///< must not be automatic
    bool keep_exact = false;                   ///< also stores double positions in Builder::exact_positions
    bool whole_positions = false;              ///< see WriteSettings::whole_positions
    bool keep_features = true;                 ///< the document has the metadata that primitives refer to
    ColumnSettings columns;
    std::string name; ///< the part's name, for messages
    /// The document's index of a scene material; -1: none.
    std::function<int(Index)> material;
    /// KHR_materials_variants of a primitive, with the document's numbers; null: it cannot stay.
    std::function<Json(const Primitive&, const Json&)> variants;
};

/// The contents of a mesh object; its accessors and views are already in the builder.
struct EncodedMesh {
    Json primitives =
        Json::array();       ///< if empty, the mesh is not written, because a glTF mesh needs primitives
    Json extensions;         ///< extensions of the mesh, or null
    std::size_t targets = 0; ///< number of morph targets per primitive
    std::size_t dropped_faces = 0; ///< degenerate faces that Draco dropped
    VertexCacheUse cache;          ///< not set with Draco
};

/// Triangulates polygons. A mesh without faces and lines is written as points. Positions become float32 with
/// min and max; indices become uint16 if they fit, else uint32. Degenerate faces are kept, but Draco drops
/// them unless it must keep them (W-FACES). Unused wedges are dropped. Throws a stage error (E-RANGE) when a
/// position does not fit float32.
[[nodiscard]] EncodedMesh encode_mesh(Builder& builder, const Mesh& mesh, const EncodeSettings& settings,
                                      Written& written);

/// The wedges of a primitive in writing order, and its triangles in that numbering.
struct Table {
    Index primitive = 0;
    std::vector<Index> wedges;
    std::vector<Index> indices;
};

/// Splits tables so that Draco compresses them well. Degenerate faces would make it store indices, so they
/// are dropped or moved to separate tables. A table with only degenerate faces stays. With morph targets,
/// indices are stored anyway.
[[nodiscard]] std::vector<Table> draco_tables(const Mesh& mesh, std::vector<Table> tables, bool targets,
                                              const EncodeSettings& settings, EncodedMesh& out);
/// Writes the primitive's accessors and extension with Draco.
void encode_draco_primitive(Builder& builder, const Mesh& mesh, const Table& table,
                            const std::vector<Column>& columns, const EncodeSettings& settings,
                            Json& primitive);
/// The positions of the table's wedges, as x, y, z triples.
[[nodiscard]] std::vector<float> positions_of(const Mesh& mesh, const std::vector<Index>& wedges);
/// The column's numbers for the table's wedges.
[[nodiscard]] AttributeData gathered(const Mesh& mesh, const Column& column,
                                     const std::vector<Index>& wedges);
/// An accessor object without buffer view; min and max on request.
[[nodiscard]] Json accessor_json(const AttributeData& data, int components, bool normalised, bool bounds);
/// Adds a view and an accessor for vertex data, with each element padded to 4 bytes. Returns the accessor's
/// index.
std::size_t add_vertex_data(Builder& builder, const AttributeData& data, int components, bool normalised,
                            bool bounds);
/// The morph target accessors for these wedges, as the primitive's "targets"; null without targets.
Json add_targets(Builder& builder, const Mesh& mesh, const std::vector<Column>& columns,
                 const std::vector<Index>& wedges);
/// glTF displaces only attributes that the primitive has. Drops the other displacements of its targets; a
/// target that would become empty displaces positions by zero.
void drop_baseless_targets(Builder& builder, Json& primitive);
/// True if the primitive had the column, or the column is new.
bool has_column(const Mesh& mesh, Index primitive, const Column& column);

/// The EXT_mesh_manifold object of a mesh whose primitives share a table; null, with a warning, when the
/// mesh is not manifold. indices: the indices of all primitives together.
[[nodiscard]] Json manifold_extension(Builder& builder, const Mesh& mesh, const std::vector<Index>& wedges,
                                      const std::vector<Index>& indices, std::size_t index_view,
                                      const Json& position, Written& written, const std::string& name);

} // namespace facetmill::io::gltf
