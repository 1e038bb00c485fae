#pragma once
// Each format has a codec, in a registry sorted by name. A codec converts bytes to a Scene and back. It
// opens no files (except a glTF's neighbours, through Neighbours) and writes none.

#include "io/bytes.hpp"
#include "mesh/lines.hpp"
#include "mesh/scene.hpp"

#include <functional>
#include <optional>

namespace facetmill::io {

/// A warning of a reader.
struct ReadWarning : Diagnostic {
    bool is_loss = true; ///< some content of the file is missing from the scene or changed
};

/// A neighbour of a file that was read.
struct ReadFile {
    std::filesystem::path path;
    std::size_t bytes = 0;
    std::string sha256 = {}; ///< digest of the bytes as read; empty: only a part of the file was read
};

/// The results of a reader besides the scene: warnings with stable ids, and the other files that it read.
struct ReadLog {
    std::vector<ReadWarning> warnings;
    std::vector<ReadFile> files;               ///< neighbours that were read (buffers, images, .mtl)
    std::vector<std::filesystem::path> absent; ///< missing neighbours that the file names
    std::vector<Lines> lines; ///< lines of the file if ReadSettings::lines is set; they are not parts then
    /// A neighbour was refused, or changed during reading. Another run may then give another scene, even
    /// with the same `files` and the same `absent`.
    bool unrepeatable = false;
    bool has_solids = false; ///< CurveSettings had an effect
};

/// Whether vertices at exactly the same position are merged: by the format's convention (STL and glTF merge
/// them), never, or always.
enum class Weld { automatic, off, exact };

/// Data decoded while writing, kept for the read-back. Only the codecs that made it use it.
struct Decodings {
    virtual ~Decodings() = default;
};

/// How finely the faces of solids (CAD) become triangles.
struct CurveSettings {
    double deviation = 0; ///< greatest distance from the surface, in metres; 0: see ratio
    double ratio = 0.001; ///< the same as a share of the diagonal of the file
    double degrees = 15;  ///< greatest angle between neighbouring triangles of a face
};

struct ReadSettings {
    Weld weld = Weld::automatic;
    std::optional<Unit> unit; ///< overrides the file's unit
    std::optional<UpAxis> up;
    std::size_t max_vertices = std::size_t{1} << 31;
    bool lines = false;            ///< lines go to the log instead of becoming parts
    bool expand_instances = false; ///< glTF: each instance of EXT_mesh_gpu_instancing is a part
    /// Drop vertices with coordinates that are not finite, with their faces and lines (W-NOT-FINITE),
    /// instead of refusing them (E-NAN).
    bool drop_not_finite = false;
    /// Folders that may hold the neighbours of a file, besides its own folder.
    std::vector<std::filesystem::path> asset_roots{};
    const Decodings* decoded = nullptr; ///< decoded data to use instead of decoding again
    CurveSettings curves{};
};

/// The extent that position bits divide.
enum class Grid { scene, mesh, even };

/// Bits of positions for Draco and quantize, or the usual number.
inline int bits_or_usual(const std::optional<std::int64_t>& bits) {
    return static_cast<int>(bits.value_or(14));
}

struct DracoSettings {
    bool on = false;
    Grid grid = Grid::even;
    std::optional<std::int64_t> position_bits;
    std::int64_t normal_bits = 10, uv_bits = 12, colour_bits = 8, generic_bits = 12;
    std::int64_t speed = 0;       ///< 0 (smallest) to 10 (fastest)
    bool keep_degenerate = false; ///< keep faces that repeat a vertex, in a separate primitive
    bool keep_decoded = false;    ///< fill Written::decoded for the read-back
};

/// KHR_mesh_quantization: attributes as small integers on a grid. Integer attributes stay unchanged.
struct QuantizeSettings {
    bool on = false;
    bool given = false; ///< the user set `on`; otherwise meshopt sets it
    Grid grid = Grid::even;
    std::optional<std::int64_t> position_bits;
    std::int64_t normal_bits = 8, uv_bits = 12, colour_bits = 8;
    std::int64_t weight_bits = 8; ///< 8: a byte, more: two bytes
};

/// EXT_meshopt_compression (streams of version 0) or KHR_meshopt_compression (of version 1).
struct MeshoptSettings {
    enum class Extension { ext, khr };

    bool on = false;
    Extension extension = Extension::ext;
    bool filters = true; ///< octahedral, quaternion and exponential coding of values that are rounded anyway
};

/// A tree of tiles, from few triangles for the whole to all triangles.
struct TileSettings {
    enum class Kind { three_d };

    bool on = false;
    Kind format = Kind::three_d;
    std::int64_t faces = 20000; ///< maximum per tile, except where borders need more
    bool implicit = false;      ///< implicit tiling, otherwise explicit
    bool given_bits = false;    ///< positions must not get more bits than Draco or quantize ask for

    std::size_t most_faces() const { return static_cast<std::size_t>(faces); }
};

/// The order of triangles and vertices of glTF, without Draco.
enum class TriangleOrder {
    automatic, ///< `size` with meshopt, otherwise `draw`
    keep,      ///< unchanged
    draw,      ///< for the vertex cache and little overdraw
    size,      ///< the candidate, mostly strips, that meshopt compresses best
    strips     ///< a single order of strips: hardly larger under meshopt, and faster to find
};

/// Vertex transformations of indexed triangles with a FIFO cache of 16 transformed vertices.
struct VertexCacheUse {
    std::size_t triangles = 0, vertices = 0;
    std::size_t before = 0, after = 0; ///< transformed vertices, in the given and in the written order
    void add(const VertexCacheUse& other);
};

/// The destination of images that a document names as files.
enum class Textures {
    automatic, ///< into the file if it is self-contained (GLB), otherwise next to it
    embed,     ///< into the written file
    copy,      ///< next to the written file, under names that begin with its stem
    reference  ///< not copied: the written file names the original paths
};

/// The grid to which positions of a part are rounded, in the part's coordinates: origin + step *
/// non-negative integers. Step 0: bounds and bits define the grid.
struct Lattice {
    Vec3 origin;
    double step = 0;
};

/// Levels of detail in glTF: parts X.lod1, X.lod2 ... are levels of the part X (MSFT_lod).
struct LevelSettings {
    bool on = false;
    double pixels = 1;                  ///< the error on the screen at which a level may replace a finer one
    double width = 1920, height = 1080; ///< of the screen, in pixels
};

struct WriteSettings {
    bool ascii = false;      ///< PLY and STL: text instead of binary
    bool big_endian = false; ///< PLY
    bool double_positions =
        false;             ///< PLY, OBJ, OFF: positions with full precision, otherwise rounded to float32
    DracoSettings draco{}; ///< glTF
    QuantizeSettings quantize{}; ///< glTF, without Draco
    MeshoptSettings meshopt{};   ///< glTF, without Draco
    TileSettings tiles{};        ///< 3D Tiles
    /// glTF: all positions are whole numbers below 2^24, which the grids of Draco and quantize keep exactly.
    bool whole_positions = false;
    TriangleOrder order = TriangleOrder::automatic; ///< glTF, without Draco
    bool mesh_manifold = false;                     ///< glTF: EXT_mesh_manifold
    LevelSettings lods{};                           ///< glTF
    std::string title{};                            ///< the output's stem, for names inside the file
    Textures textures = Textures::automatic;        ///< glTF, OBJ
    std::filesystem::path directory{};              ///< the output's directory, for Textures::reference

    std::optional<Box> drawn{}; ///< drawn_bounds of the scene, if they are known

    std::vector<int> part_bits{}; ///< position bits of each part; empty: the bits of Draco or quantize

    std::vector<Lattice> lattices{}; ///< position grid of each part, within its bits; empty: no grids
    bool interleave = false; ///< glTF, without Draco and meshopt: interleave the attributes of a vertex
    bool drop_names = false; ///< glTF: omit names that only people use

    /// The position bits that Draco or quantize asks for. Call it only if one of them is on.
    int position_bits() const {
        return bits_or_usual(draco.on ? draco.position_bits : quantize.position_bits);
    }

    /// The bits of the grid for positions of a part. The longest side has 2^bits - 1 steps. 0: no grid.
    int grid_bits(std::size_t part) const {
        if (!draco.on && !quantize.on) return 0;
        if (part < part_bits.size()) return part_bits[part];
        return position_bits();
    }
    /// The grid of a part; step 0 if bounds and bits define the grid.
    Lattice lattice(std::size_t part) const {
        return grid_bits(part) > 0 && part < lattices.size() ? lattices[part] : Lattice{};
    }
};

/// A written file: the main one first, then its neighbours (a .gltf's .bin and images, an .obj's .mtl).
struct OutputFile {
    std::filesystem::path name; ///< relative to the target's directory
    Bytes bytes;
};

/// The statistics of a written tree of tiles.
struct TilesWritten {
    std::size_t tiles = 0, leaves = 0, levels = 0;
    std::size_t largest = 0; ///< triangles of the largest tile
    double error = 0;        ///< error of the root, in metres
};

struct Written {
    std::vector<OutputFile> files;
    std::vector<Diagnostic> warnings;
    AttributeChanges changes;      ///< attributes that the format cannot hold are listed as dropped
    std::size_t dropped_faces = 0; ///< faces of the scene missing from the file, for the read-back
    VertexCacheUse cache{};        ///< cache use of the reordered meshes
    std::optional<TilesWritten> tiles{};
    std::shared_ptr<const Decodings> decoded{};
};

/// An option of `write` that not all formats honour.
struct WriteOption {
    std::string name;
    std::function<bool(const WriteSettings&)> asked; ///< its value has an effect
};

/// The abilities of a format. `write` refuses scenes and options by them, and `facetmill formats` prints
/// them. No other code asks for a format by its name.
struct Capabilities {
    bool polygons = false;       ///< faces of any size, otherwise only triangles
    bool shares_vertices = true; ///< faces share vertices, otherwise a reader must weld them
    bool normals = true;
    bool transforms =
        false; ///< parts keep their transforms and names, otherwise all parts are in world space
    bool skins = false;
    bool points = false;                ///< scenes without faces: point clouds
    bool points_and_faces = false;      ///< parts of points next to parts with faces
    bool lines = false;                 ///< parts of lines
    bool documents = false;             ///< scenes without meshes: nodes, cameras, animations
    bool full_precision = false;        ///< WriteSettings::double_positions
    std::vector<WriteOption> options{}; ///< the options of `write` that it honours
    bool always_draco = false;          ///< cannot be written without Draco
    std::string attributes{};           ///< the attributes that it holds, as text
    std::string companion{};            ///< the suffix of a required neighbour: ".bin"
    std::string library{};              ///< the suffix of the neighbour with the materials: ".mtl"
    bool curves = false;                ///< reading honours CurveSettings
    bool copies_images =
        false; ///< image files stay separate files next to it, unless Textures overrides this

    bool honours(std::string_view option) const;
};

/// An image that a document names as a file.
struct NamedImage {
    std::filesystem::path relative; ///< path relative to the file
    std::string digest;             ///< digest, equal for equal images
    bool is_file = true; ///< the file exists at this path; otherwise the image was derived from others
};

/// The facts that the header of a mesh file gives.
struct FileHeader {
    std::string format{};
    Unit unit = Unit::unknown;
    UpAxis up = UpAxis::unknown;
    std::vector<std::string> parts{}; ///< part names; empty if only reading the whole file finds them
    std::vector<std::filesystem::path> files{}; ///< neighbours that reading it opens, existing or not
    /// Materials and images of the scene that reading gives. Both need more than the header, so they are
    /// called only if needed. Empty: none. Only readable images are listed, named as in a written document.
    std::function<bool()> has_materials{};
    std::function<std::vector<NamedImage>()> images{};
};

/// The verdict of a library that reads a written file in addition to our own reader.
struct SecondReading {
    std::string reader{};                   ///< its name; empty if there is none for the file
    std::string not_asked{};                ///< why it did not read the file; empty if it did
    std::vector<std::string> differences{}; ///< to our reader; only the first ones
};

struct Codec {
    std::string name;                    ///< for example "ply"
    std::string about;                   ///< one line, for `facetmill formats`
    std::vector<std::string> extensions; ///< lower case, without the dot; the first is the usual one
    Unit unit = Unit::unknown;           ///< the unit of a written file; unknown: the scene's unit
    UpAxis up = UpAxis::unknown;
    Capabilities can{};
    /// Whether the bytes have this format, regardless of the name: 0 no, 1 perhaps, 2 certainly (a magic
    /// number).
    std::function<int(Span)> sniff;
    /// Throws a malformed-input error with the position (line, or byte offset in the message), also if
    /// counts exceed the size of the file. Throws a limit error if counts exceed the capacity of a mesh.
    /// Sizes and counts from the file are checked before use.
    std::function<Scene(const Input&, const ReadSettings&, ReadLog&)> read;
    /// Throws a stage error if the format cannot hold the scene at all. Empty: the format is read-only.
    std::function<Written(const Scene&, const WriteSettings&)> write = {};
    /// Reads only the header. Throws the errors of read if the header is malformed. Sets the neighbours, the
    /// materials, and the part names if the header gives them. Empty: the format has no header.
    std::function<void(const Input&, FileHeader&)> peek = {};
    /// Reads a written file with another library and compares it with our reading. May be empty.
    std::function<SecondReading(const Input&, const Scene&)> read_again = {};
    /// What to install before this machine can read the format; an empty text if nothing. Empty: nothing.
    std::function<std::string()> missing = {};

    /// Whether this machine can read the format.
    bool reads() const { return read && (!missing || missing().empty()); }
};

/// Registers a codec; one static object per codec file.
struct RegisterCodec {
    explicit RegisterCodec(Codec codec);
};

const std::vector<Codec>& codecs();
/// The codec for a file name's extension (.gz and .zst ignored), or null.
[[nodiscard]] const Codec* codec_for(const std::filesystem::path& path);
/// The codec whose magic number the input begins with, or null. If several match, the file name decides.
[[nodiscard]] const Codec* sure_codec(const Input& input);
[[nodiscard]] const Codec* codec_named(std::string_view name);
/// The sorted names of all codecs that read, or that write.
[[nodiscard]] std::vector<std::string> names_of_readers();
[[nodiscard]] std::vector<std::string> names_of_writers();

/// Reads a mesh file. A magic number decides the format, otherwise the extension does. Text may be UTF-8 or
/// UTF-16. Throws the errors of Codec::read, and a usage error (E-FORMAT) if no codec reads it. Positions
/// that are not finite are malformed (E-NAN, with vertex and file) unless ReadSettings::drop_not_finite is
/// set.
[[nodiscard]] Scene read_scene(const Input& file, const ReadSettings& settings, ReadLog& log,
                               const Codec* forced = nullptr);

/// Detects the format of a file and reads its header. Throws the errors of read_scene for the header.
[[nodiscard]] FileHeader file_header(const Input& file, const ReadSettings& settings,
                                     const Codec* forced = nullptr);

} // namespace facetmill::io
