#pragma once
// The options of write, and the settings that follow from them.

#include "geometry/normals/normals.hpp"
#include "stage/stage.hpp"
#include "stages/write/origin.hpp"

namespace facetmill::write_stage {

/// The parts with a normal map that get tangents.
enum class Tangents { keep, missing, all };

struct WriteOptions {
    enum class Precision { automatic, single, full };

    PathText path;
    std::string format;
    Unit unit = Unit::unknown;
    UpAxis up = UpAxis::unknown;
    bool triangulate = false;
    Precision precision = Precision::automatic;
    NormalKind normals = NormalKind::keep;
    std::optional<Angle> feature_angle; ///< for smooth normals
    OriginOption origin;
    Tangents tangents = Tangents::keep;
    io::WriteSettings file; ///< the options that only some formats honour
};

void declare_write(Declare<WriteOptions>& d);
/// Checks that the declaration cannot express: file names without a format, and options that the format does
/// not support.
void verify_write(const WriteOptions& o, const Value& given, Problems& problems);
/// The output file, and the buffer file of a .gltf.
[[nodiscard]] StageFiles files_of_write(const WriteOptions& o);

/// The format given by name, by the option tiles, or by the suffix; null if unknown.
[[nodiscard]] const io::Codec* codec_of(const WriteOptions& o);
/// The settings for the codec, without bits and grids that depend on the scene.
[[nodiscard]] io::WriteSettings settings_of(const WriteOptions& o, const io::Codec& codec,
                                            const std::filesystem::path& target);

} // namespace facetmill::write_stage
