#pragma once
// The options of write, and the settings that follow from them.

#include "geometry/normals/normals.hpp"
#include "stage/stage.hpp"
#include "stages/write/origin.hpp"

namespace facetmill::write_stage {

/// The extent that position bits divide.
enum class Grid { scene, mesh, even };

struct DracoOptions {
    enum class Degenerate { drop, keep };

    bool on = true;
    Grid grid = Grid::even;
    std::optional<std::int64_t> position_bits;
    std::int64_t normal_bits = 10, uv_bits = 12, colour_bits = 8, generic_bits = 12, speed = 0;
    Degenerate degenerate_faces = Degenerate::drop;
};

struct QuantizeOptions {
    bool on = true;
    Grid grid = Grid::even;
    std::optional<std::int64_t> position;
    std::int64_t normal = 8, uv = 12, colour = 8, weights = 8;
};

struct MeshoptOptions {
    bool on = true, filters = true;
    io::MeshoptSettings::Extension extension = io::MeshoptSettings::Extension::ext;
};

struct TilesOptions {
    enum class Kind { three_d };

    Kind format = Kind::three_d;
    std::int64_t faces = 20000;
    bool implicit = false;
};

/// The parts with a normal map that get tangents.
enum class Tangents { keep, missing, all };

struct WriteOptions {
    enum class Precision { automatic, single, full };

    PathText path;
    std::string format;
    Unit unit = Unit::unknown;
    UpAxis up = UpAxis::unknown;
    bool ascii = false, big_endian = false, mesh_manifold = false, lods = false, drop_names = false,
         interleave = false, triangulate = false;
    Precision precision = Precision::automatic;
    NormalKind normals = NormalKind::keep;
    std::optional<Angle> feature_angle; ///< for smooth normals
    OriginOption origin;
    Tangents tangents = Tangents::keep;
    std::optional<DracoOptions> draco;
    std::optional<QuantizeOptions> quantize;
    std::optional<MeshoptOptions> meshopt;
    std::optional<TilesOptions> tiles;
    io::Textures textures = io::Textures::automatic;
    io::TriangleOrder order = io::TriangleOrder::automatic;
};

void declare_write(Declare<WriteOptions>& d);
/// Checks that the declaration cannot express: file names without a format, and options that the format does
/// not support.
void verify_write(const WriteOptions& o, const Value& given, Problems& problems);
/// The output file, and the buffer file of a .gltf.
[[nodiscard]] StageFiles files_of_write(const WriteOptions& o);

/// The format given by name, by the option tiles, or by the suffix; null if unknown.
[[nodiscard]] const io::Codec* codec_of(const WriteOptions& o);
/// The settings for the codec. Position bits have their usual values if not given.
[[nodiscard]] io::WriteSettings settings_of(const WriteOptions& o, const io::Codec& codec,
                                            const std::filesystem::path& target);

} // namespace facetmill::write_stage
