#pragma once
// Draco's compressed meshes, without Draco's types: its headers are included in this folder only.

#include "io/bytes.hpp"
#include "io/codec.hpp"
#include "mesh/mesh.hpp"

#include <memory>
#include <string>
#include <unordered_map>

namespace facetmill::io {

/// What Draco takes an attribute for: it decides prediction and quantisation.
/// identifier: whole numbers, which nothing may round.
enum class DracoKind { position, normal, uv, colour, generic, identifier };

/// One attribute of a compressed mesh: a tuple per point.
struct DracoColumn {
    std::string name; ///< from the metadata, or empty
    DracoKind kind = DracoKind::generic;
    std::uint32_t id = 0; ///< the unique id by which glTF names it
    int components = 1;
    bool normalised = false;
    AttributeData data; ///< [points * components]
};

/// A decoded mesh. A point is what glTF calls a vertex, here a wedge.
struct DracoMesh {
    std::size_t points = 0;
    std::vector<Index> triangles; ///< three points each
    std::vector<DracoColumn> columns;
};

/// True when the bytes begin with Draco's magic number.
bool is_draco(Span bytes);
/// What the bytes may hold.
enum class DracoContents { mesh, mesh_or_points };
/// Decodes a mesh, or points without triangles. Throws malformed (E-DRACO), also for what is not asked for.
DracoMesh decode_draco(Span bytes, DracoContents contents = DracoContents::mesh);

/// What bytes were decoded to, by their SHA-256, so that the same bytes are decoded once.
class DracoDecodings : public Decodings {
  public:
    void add(Span bytes, std::shared_ptr<const DracoMesh> mesh);
    /// As decode_draco, where the bytes are known without decoding them.
    DracoMesh decode(Span bytes, DracoContents contents) const;

  private:
    std::unordered_map<std::string, std::shared_ptr<const DracoMesh>> meshes_;
};
/// With what is known, if there is any and it is of Draco.
DracoMesh decode_draco(Span bytes, DracoContents contents, const Decodings* known);

/// A mesh to compress.
struct DracoInput {
    std::vector<float> vertices; ///< x, y, z: one per vertex and not per point, so that seams do not crack
    std::vector<Index> point_vertex;  ///< [points]
    std::vector<Index> triangles;     ///< three points each
    std::vector<DracoColumn> columns; ///< all but the positions; ids are ignored
    float origin[3] = {0, 0, 0}; ///< of the grid that positions are quantised to: the same for all primitives
    float range = 1;             ///< of a mesh, so that their common borders stay together
    float extent = 1;            ///< what the bits are meant to divide: at most the range
    bool keep_order = false; ///< points keep their order (morph targets are not compressed and rely on it)
};

/// Sets the quantisation grid to the cube of the mesh's bounds, rounded outwards to what the library stores.
void set_draco_grid(const Mesh& mesh, DracoInput& input);

/// Makes the steps of the grid 1, for whole numbers that reach no farther than 2^bits - 1 from its origin.
void set_whole_steps(DracoInput& input, int bits);

/// Makes a grid of so many bits wider, so that its steps are as long as this one; not narrower, nor where a
/// step is below the millionths that the library stores.
void widen_draco_grid(DracoInput& input, double step, int bits);

/// The faces that name a vertex twice, which Edgebreaker cannot hold; three corners each.
std::vector<bool> degenerate_faces(const std::vector<Index>& triangles,
                                   const std::vector<Index>& point_vertex);

struct DracoOutput {
    Bytes bytes;
    std::shared_ptr<const DracoMesh> decoded; ///< what a reader will see, but for
    DracoColumn positions;                    ///< those of the grid, alike on every processor
    std::uint32_t position_id = 0;
    std::vector<std::uint32_t> ids; ///< of the columns, in order
    bool sequential = false;
};

/// Compresses with Edgebreaker; with the sequential method when order matters, or when Edgebreaker would drop
/// faces: it drops degenerate ones, so take them out before. Numbers are quantised alike on every processor.
/// Throws stage (E-DRACO) when Draco cannot do it at all.
DracoOutput encode_draco(const DracoInput& input, const DracoSettings& settings);

/// Compresses points without triangles, each a vertex, by a k-d tree, which puts them in another order; in
/// sequence where an attribute has numbers that the tree does not take. Quantises as encode_draco, but
/// normals as plain numbers. Throws stage (E-DRACO).
Bytes encode_draco_points(const DracoInput& input, const DracoSettings& settings);

} // namespace facetmill::io
