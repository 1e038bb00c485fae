#pragma once
// A Mesh as glTF primitives: taken apart along its primitives, wedges as glTF vertices, plain or under Draco.

#include "io/codec.hpp"
#include "io/gltf/document/builder.hpp"
#include "io/gltf/numbers/columns.hpp"

namespace facetmill::io::gltf {

/// What a buffer view is for, as glTF says it.
inline constexpr int array_buffer = 34962, element_buffer = 34963;

struct EncodeSettings {
    DracoSettings draco;
    double draco_step = 0;                     ///< of positions, where it is more than the bits would give
    QuantizeSettings quantize;                 ///< how attributes will be rounded
    bool filters = false;                      ///< and whether as meshopt's filters want them
    bool manifold = false;                     ///< write EXT_mesh_manifold
    TriangleOrder order = TriangleOrder::keep; ///< not automatic
    bool keep_exact = false;                   ///< positions in doubles go to Builder::exact_positions, too
    bool whole_positions = false;              ///< see WriteSettings
    bool keep_features = true;                 ///< metadata that primitives refer to is in the document
    bool points = false;                       ///< a mesh without faces is written as points, else not at all
    ColumnSettings columns;
    std::string name; ///< of the part, for messages
    /// The document's index for a scene material; -1: none.
    std::function<int(Index)> material;
};

/// What goes into a mesh object; the accessors and views are in the builder already.
struct EncodedMesh {
    Json primitives =
        Json::array();       ///< empty when nothing of the mesh is written: then it cannot be a glTF mesh
    Json extensions;         ///< of the mesh, or null
    std::size_t targets = 0; ///< morph targets of each primitive
    std::size_t dropped_faces = 0; ///< degenerate ones, under Draco
    VertexCacheUse cache;          ///< not under Draco
};

/// Polygons are triangulated. Positions become float32 with min and max, indices uint16 where they fit, else
/// uint32. Degenerate faces are kept, except under Draco unless it is to keep them (W-FACES); wedges that no
/// face uses are not. Throws stage (E-RANGE) when a position does not fit float32.
EncodedMesh encode_mesh(Builder& builder, const Mesh& mesh, const EncodeSettings& settings, Written& written);

/// The wedges of one primitive in the order they are written, and its triangles in that numbering.
struct Table {
    Index primitive = 0;
    std::vector<Index> wedges;
    std::vector<Index> indices;
};

/// What Draco compresses well: degenerate faces, which would have it fall back to storing indices, are
/// dropped or go into tables of their own. A table that has nothing else stays. With morph targets indices
/// are stored anyway.
std::vector<Table> draco_tables(const Mesh& mesh, std::vector<Table> tables, bool targets,
                                const EncodeSettings& settings, EncodedMesh& out);
/// Draco's part: fills the primitive's accessors and extension.
void encode_draco_primitive(Builder& builder, const Mesh& mesh, const Table& table,
                            const std::vector<Column>& columns, const EncodeSettings& settings,
                            Json& primitive);
/// The positions of the table's wedges, x y z each.
std::vector<float> positions_of(const Mesh& mesh, const std::vector<Index>& wedges);
/// The column's numbers for the table's wedges.
AttributeData gathered(const Mesh& mesh, const Column& column, const std::vector<Index>& wedges);
/// An accessor object without buffer view; min and max when asked for.
Json accessor_json(const AttributeData& data, int components, bool normalised, bool bounds);
/// A view and an accessor for vertex data, each element padded to 4 bytes. Returns the accessor's index.
std::size_t add_vertex_data(Builder& builder, const AttributeData& data, int components, bool normalised,
                            bool bounds);
/// The accessors of morph targets for these wedges, as the primitive's "targets"; null when there are none.
Json add_targets(Builder& builder, const Mesh& mesh, const std::vector<Column>& columns,
                 const std::vector<Index>& wedges);
/// True when the column is one of those that the primitive had, or is new since.
bool has_column(const Mesh& mesh, Index primitive, const Column& column);

/// The EXT_mesh_manifold object of a mesh whose primitives use one table; null, with a warning, when it is
/// not manifold. indices are those of all primitives together.
Json manifold_extension(Builder& builder, const Mesh& mesh, const std::vector<Index>& wedges,
                        const std::vector<Index>& indices, std::size_t index_view, const Json& position,
                        Written& written, const std::string& name);

} // namespace facetmill::io::gltf
