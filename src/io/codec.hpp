#pragma once
// One codec per format, behind one registry sorted by name. A codec turns bytes into a Scene and back; it
// opens no files itself (except a glTF's neighbours, through Neighbours) and writes none.

#include "io/bytes.hpp"
#include "mesh/lines.hpp"
#include "mesh/scene.hpp"

#include <functional>
#include <optional>

namespace facetmill::io {

/// A warning of a reader.
struct ReadWarning : Diagnostic {
    bool is_loss = true; ///< something of the file is not in the scene, or not as the file has it
};

/// A neighbour of a file that was read.
struct ReadFile {
    std::filesystem::path path;
    std::size_t bytes = 0;
    std::string sha256 = {}; ///< of the bytes as they were read; empty: only a part of the file was read
};

/// What a reader wants to tell besides the scene: warnings with stable ids, and other files it read.
struct ReadLog {
    std::vector<ReadWarning> warnings;
    std::vector<ReadFile> files;               ///< neighbours that were read (buffers, images, .mtl)
    std::vector<std::filesystem::path> absent; ///< neighbours that the file names and that are not there
    std::vector<Lines> lines; ///< of the file, when ReadSettings::lines asks for them; they are no parts then
    /// A neighbour was refused, or changed while it was read: reading again may give another scene although
    /// all of `files` are the same and those of `absent` still missing.
    bool unrepeatable = false;
};

/// Whether vertices at exactly the same place become one: as the format needs it (STL and glTF do), never, or
/// always.
enum class Weld { automatic, off, exact };

/// What was decoded while a file was written, for whoever reads it back. Only the codecs that made it look
/// into it.
struct Decodings {
    virtual ~Decodings() = default;
};

struct ReadSettings {
    Weld weld = Weld::automatic;
    std::optional<Unit> unit; ///< overrides what the format says
    std::optional<UpAxis> up;
    std::size_t max_vertices = std::size_t{1} << 31;
    bool lines = false;            ///< lines go to the log instead of being parts
    bool expand_instances = false; ///< glTF: each instance of EXT_mesh_gpu_instancing is a part
    /// Vertices whose coordinates are not finite are left out, with their faces and lines (W-NOT-FINITE), and
    /// not refused (E-NAN).
    bool drop_not_finite = false;
    /// Folders below which the neighbours of a file may lie, besides its own.
    std::vector<std::filesystem::path> asset_roots{};
    const Decodings* decoded = nullptr; ///< those that are known already
};

struct DracoSettings {
    bool on = false;
    int position_bits = 14, normal_bits = 10, uv_bits = 12, colour_bits = 8, generic_bits = 12;
    int speed = 0;                ///< 0 smallest .. 10 fastest
    bool keep_degenerate = false; ///< faces that name a vertex twice stay, in a primitive of their own
    bool keep_decoded = false;    ///< Written::decoded is wanted, to read the file back
};

/// KHR_mesh_quantization: attributes as small integers on a grid. What is stored as integers already stays.
struct QuantizeSettings {
    bool on = false;
    int position_bits = 14, normal_bits = 8, uv_bits = 12, colour_bits = 8;
    int weight_bits = 8; ///< 8: a byte, more: two bytes
};

/// EXT_meshopt_compression (streams of version 0) or KHR_meshopt_compression (of version 1).
struct MeshoptSettings {
    enum class Extension { ext, khr };

    bool on = false;
    Extension extension = Extension::ext;
    bool filters = true; ///< octahedral, quaternion and exponential coding of what is rounded anyway
};

/// A tree of tiles, from the whole in few triangles to all of them.
struct TileSettings {
    std::size_t faces = 20000; ///< that a tile has at the most, but where borders need more
    bool implicit = false;     ///< implicit tiling, else explicit
    bool given_bits = false;   ///< the bits of positions are not to be more than Draco or quantize say
};

/// The order of triangles and vertices of glTF, without Draco.
enum class TriangleOrder {
    automatic, ///< for size under meshopt, else for drawing
    keep,      ///< as the scene has it
    draw,      ///< for a cache of transformed vertices, and so that few pixels are drawn twice
    size,      ///< the one of several, mostly strips, that meshopt compresses best
    strips     ///< one order of strips: hardly larger under meshopt, and found quicker
};

/// Indexed triangles as a cache of 16 transformed vertices, first in, first out, meets them.
struct VertexCacheUse {
    std::size_t triangles = 0, vertices = 0;
    std::size_t before = 0, after = 0; ///< how often a vertex is transformed, as given and as written
    void add(const VertexCacheUse& other);
};

/// Where the images go that a document names as files.
enum class Textures {
    automatic, ///< into the file where it is one (GLB), else beside it
    embed,     ///< among the written file's own bytes
    copy,      ///< beside the written file, under names that begin with its stem
    reference  ///< nowhere: the written file names them where they lie
};

/// Where positions of a part are rounded to, in its own coordinates: origin + step * whole numbers, which are
/// not below zero in the part. No step: the bounds and the bits say.
struct Lattice {
    Vec3 origin;
    double step = 0;
};

struct WriteSettings {
    bool ascii = false;      ///< PLY and STL: text instead of binary
    bool big_endian = false; ///< PLY
    bool double_positions =
        false;                   ///< PLY, OBJ, OFF: positions with all their digits, else rounded to float32
    DracoSettings draco{};       ///< glTF
    QuantizeSettings quantize{}; ///< glTF, without Draco
    MeshoptSettings meshopt{};   ///< glTF, without Draco
    TileSettings tiles{};        ///< 3D Tiles
    /// glTF: all positions are whole numbers below 2^24, which the grids of Draco and quantize keep exactly.
    bool whole_positions = false;
    TriangleOrder order = TriangleOrder::automatic; ///< glTF, without Draco
    bool mesh_manifold = false;                     ///< glTF: EXT_mesh_manifold
    bool lods = false;   ///< glTF: parts X.lod1, X.lod2 ... are levels of the part X (MSFT_lod)
    std::string title{}; ///< the output's stem, for names inside the file
    Textures textures = Textures::automatic; ///< glTF, OBJ
    std::filesystem::path directory{};       ///< the output's, for Textures::reference

    std::vector<int> part_bits{}; ///< of each part's positions; empty: as Draco or quantize say

    std::vector<Lattice> lattices{}; ///< of each part's positions, within its bits; empty: none has one
    bool interleave = false;         ///< glTF, without Draco and meshopt: a vertex's attributes side by side
    bool names = true;               ///< glTF: also of what only people look for by name

    /// Bits of the grid that positions of a part are rounded to: its longest side is divided into 2^bits - 1
    /// steps. 0: there is none.
    int grid_bits(std::size_t part) const {
        if (!draco.on && !quantize.on) return 0;
        if (part < part_bits.size()) return part_bits[part];
        return draco.on ? draco.position_bits : quantize.position_bits;
    }
    /// Of a part; its step is 0 where the bounds and the bits say where positions are rounded to.
    Lattice lattice(std::size_t part) const {
        return grid_bits(part) > 0 && part < lattices.size() ? lattices[part] : Lattice{};
    }
};

/// A written file: the main one first, then its neighbours (a .gltf's .bin and images, an .obj's .mtl).
struct OutputFile {
    std::filesystem::path name; ///< relative to the target's directory
    Bytes bytes;
};

/// What a tree of tiles came to.
struct TilesWritten {
    std::size_t tiles = 0, leaves = 0, levels = 0;
    std::size_t largest = 0; ///< triangles of the largest tile
    double error = 0;        ///< of the root, in metres
};

struct Written {
    std::vector<OutputFile> files;
    std::vector<Diagnostic> warnings;
    AttributeChanges changes;      ///< what the format cannot hold is dropped, and said
    std::size_t dropped_faces = 0; ///< that the scene has and the file has not, for the read-back
    VertexCacheUse cache{};        ///< of the meshes that were put in order
    std::optional<TilesWritten> tiles{};
    std::shared_ptr<const Decodings> decoded{};
};

/// What a format can hold, and in which ways it is written. `write` refuses options by it, and `facetmill
/// formats` prints it; nothing asks for a format by its name.
struct Capabilities {
    enum class Draco { never, on_request, always };

    bool polygons = false;       ///< faces of any size; else triangles
    bool shares_vertices = true; ///< faces name common vertices; else a reader welds them
    bool normals = true;
    bool transforms = false; ///< parts keep their transforms and names; else all are in world space
    bool skins = false;
    bool points = false;         ///< scenes without faces: point clouds
    bool lines = false;          ///< parts of lines
    bool text = false;           ///< WriteSettings::ascii
    bool big_endian = false;     ///< WriteSettings::big_endian
    bool full_precision = false; ///< WriteSettings::double_positions
    bool mesh_manifold = false;  ///< WriteSettings::mesh_manifold
    bool lods = false;           ///< WriteSettings::lods
    bool textures = false;       ///< WriteSettings::textures
    bool quantize = false;       ///< WriteSettings::quantize
    bool meshopt = false;        ///< WriteSettings::meshopt
    bool order = false;          ///< WriteSettings::order
    bool tiles = false;          ///< WriteSettings::tiles
    Draco draco = Draco::never;  ///< WriteSettings::draco
    std::string attributes{};    ///< which it holds, in words
    std::string companion{};     ///< the suffix of a file beside it that it cannot do without: ".bin"
    std::string library{};       ///< the suffix of a file beside it that holds the materials: ".mtl"
    bool copies_images = false;  ///< images that are files stay files, beside it, unless Textures says else
};

/// A capability that is there or not, by its name.
struct Capability {
    const char* name;
    bool Capabilities::*flag;
};
const std::vector<Capability>& capabilities();

/// An image that a document names as a file.
struct NamedImage {
    std::filesystem::path relative; ///< to the file
    std::string digest;             ///< equal for equal bytes
    bool is_file = true;            ///< at that place; else it was made of others
};

/// What is known of a mesh file from its header.
struct FileHeader {
    std::string format{};
    Unit unit = Unit::unknown;
    UpAxis up = UpAxis::unknown;
    std::vector<std::string> parts{};           ///< their names; empty when only the whole file tells them
    std::vector<std::filesystem::path> files{}; ///< neighbours that reading it opens, there or not
    /// What a scene read from it has, which takes more than the header to know: so these are called only
    /// where it matters. Empty: nothing. Images are those that can be read, as a written document names them.
    std::function<bool()> has_materials{};
    std::function<std::vector<NamedImage>()> images{};
};

struct Codec {
    std::string name;                    ///< "ply"
    std::string about;                   ///< one line, for `facetmill formats`
    std::vector<std::string> extensions; ///< lower case, without the dot; the first is the usual one
    Unit unit = Unit::unknown;           ///< what a written file's numbers mean; unknown: as the scene has it
    UpAxis up = UpAxis::unknown;
    Capabilities can{};
    /// Whether the bytes are of this format, whatever the name says; 0 no, 1 perhaps, 2 surely (a magic
    /// number).
    std::function<int(Span)> sniff;
    /// Throws Error malformed with the place (line, or byte offset in the message), also when counts exceed
    /// what the file holds; limit when they exceed what can be held. Sizes and counts from the file are never
    /// trusted before they are checked.
    std::function<Scene(const Input&, const ReadSettings&, ReadLog&)> read;
    /// Throws Error stage when the scene cannot be held by the format at all. Empty: the format is not
    /// written.
    std::function<Written(const Scene&, const WriteSettings&)> write = {};
    /// Reads only the header: throws as read when it is malformed, and sets the names of the parts, where
    /// they are known before the rest is read, the files beside it, and whether it has materials. Empty: the
    /// format has no header.
    std::function<void(const Input&, FileHeader&)> peek = {};
};

/// Makes a codec known; one static object per codec file.
struct RegisterCodec {
    explicit RegisterCodec(Codec codec);
};

const std::vector<Codec>& codecs();
/// The codec for a file name's extension (.gz and .zst ignored), or null.
const Codec* codec_for(const std::filesystem::path& path);
/// The codec whose magic number the input begins with; of several, the one that its name asks for. Or null.
const Codec* sure_codec(const Input& input);
const Codec* codec_named(std::string_view name);
/// The names of all codecs that read, or that write, sorted.
std::vector<std::string> names_of_readers();
std::vector<std::string> names_of_writers();

/// Reads a mesh file: by content where it is sure, else by extension. Text may be UTF-8 or UTF-16. Throws as
/// Codec::read, usage (E-FORMAT) when no codec takes it. Positions that are not finite are malformed (E-NAN)
/// with the vertex and file, unless ReadSettings::drop_not_finite.
Scene read_scene(const Input& file, const ReadSettings& settings, ReadLog& log,
                 const Codec* forced = nullptr);

/// Sniffs a file and reads its header. Throws as read_scene, for what the header shows.
FileHeader file_header(const Input& file, const ReadSettings& settings, const Codec* forced = nullptr);

} // namespace facetmill::io
