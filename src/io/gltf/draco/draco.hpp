#pragma once
// Draco's compressed meshes, without Draco's types: only this folder includes its headers.

#include "io/bytes.hpp"
#include "io/codec.hpp"
#include "mesh/mesh.hpp"

#include <memory>
#include <string>
#include <unordered_map>

namespace facetmill::io {

/// Draco's attribute kind, which decides prediction and quantisation. identifier: integers that must not be
/// rounded.
enum class DracoKind { position, normal, uv, colour, generic, identifier };

/// An attribute of a compressed mesh, with a tuple per point.
struct DracoColumn {
    std::string name; ///< the name in the metadata; may be empty
    DracoKind kind = DracoKind::generic;
    std::uint32_t id = 0; ///< the unique id that glTF refers to
    int components = 1;
    bool normalised = false;
    AttributeData data; ///< [points * components]
};

/// A decoded mesh. A point is a glTF vertex, called a wedge here.
struct DracoMesh {
    std::size_t points = 0;
    std::vector<Index> triangles; ///< three points each
    std::vector<DracoColumn> columns;
    std::size_t metadata = 0; ///< entries of metadata other than names of columns, which are not read
};

/// True when the bytes begin with Draco's magic number.
bool is_draco(Span bytes);
/// The kinds of data that are accepted.
enum class DracoContents { mesh, mesh_or_points };
/// Decodes a mesh, or points without triangles. Throws a malformed-input error (E-DRACO), also for data of
/// another kind.
[[nodiscard]] DracoMesh decode_draco(Span bytes, DracoContents contents = DracoContents::mesh);

/// Decoded contents by the SHA-256 of the bytes, so that equal bytes are decoded once.
class DracoDecodings : public Decodings {
  public:
    void add(Span bytes, std::shared_ptr<const DracoMesh> mesh);
    /// Like decode_draco, but reuses contents that are already known.
    DracoMesh decode(Span bytes, DracoContents contents) const;

  private:
    std::unordered_map<std::string, std::shared_ptr<const DracoMesh>> meshes_;
};
/// Uses known contents, if known is not null and belongs to Draco.
[[nodiscard]] DracoMesh decode_draco(Span bytes, DracoContents contents, const Decodings* known);

/// A mesh to compress.
struct DracoInput {
    std::vector<float> vertices;      ///< x, y, z: per vertex, not per point, so that seams do not crack
    std::vector<Index> point_vertex;  ///< [points] vertices
    std::vector<Index> triangles;     ///< three points each
    std::vector<DracoColumn> columns; ///< all except positions; ids are ignored
    float origin[3] = {0, 0, 0};      ///< origin of the quantisation grid, the same for all primitives
    float range = 1;         ///< range of the whole mesh, so that common borders of its primitives match
    float extent = 1;        ///< the length that the bits divide; at most the range
    bool keep_order = false; ///< needed for morph targets, which are not compressed and rely on the order
};

/// Sets the quantisation grid to the cube of the mesh's bounds, rounded outwards to the library's stored
/// precision.
void set_draco_grid(const Mesh& mesh, DracoInput& input);

/// Sets the grid step to 1. Coordinates must be integers at most 2^bits - 1 from the origin.
void set_whole_steps(DracoInput& input, int bits);

/// Sets the grid with this many bits to the origin and the step of a lattice that other meshes share. If it
/// does not reach the mesh from there, only its steps become as long. Does nothing without a step.
void set_draco_lattice(const Mesh& mesh, const Vec3& origin, double step, DracoInput& input, int bits);

/// Marks faces that repeat a vertex, which Edgebreaker cannot store; three corners each.
[[nodiscard]] std::vector<bool> degenerate_faces(const std::vector<Index>& triangles,
                                                 const std::vector<Index>& point_vertex);

struct DracoOutput {
    Bytes bytes;
    std::shared_ptr<const DracoMesh> decoded; ///< as decoded; its positions may depend on the processor
    DracoColumn positions;                    ///< positions on the grid, equal on every processor
    std::uint32_t position_id = 0;
    std::vector<std::uint32_t> ids; ///< in column order
    bool sequential = false;
};

/// Compresses with Edgebreaker. Uses the sequential method if the order matters, or if Edgebreaker would
/// drop faces. It drops degenerate faces, so remove these first. Numbers are quantised identically on every
/// processor. Throws a stage error (E-DRACO) when Draco cannot encode the mesh.
[[nodiscard]] DracoOutput encode_draco(const DracoInput& input, const DracoSettings& settings);

/// Compresses points without triangles in a k-d tree, which changes their order. Each point is a vertex.
/// Uses the sequential method if the tree does not support the numbers of an attribute. Quantises like
/// encode_draco, but stores normals as plain numbers. Throws a stage error (E-DRACO).
[[nodiscard]] Bytes encode_draco_points(const DracoInput& input, const DracoSettings& settings);

} // namespace facetmill::io
