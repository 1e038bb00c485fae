#pragma once
// Helpers of write: conversion to the file's convention and precision, and staging of the file.

#include "stages/write/options.hpp"

namespace facetmill::write_stage {

struct WriteReport {
    struct Bits {
        int position_bits = 0; ///< the largest number of bits of any part
        std::optional<int> least;
        std::string why;
    };
    std::optional<double> factor;
    std::optional<std::string> up, fits;
    std::optional<Bits> draco, quantize;
    std::optional<OriginReport> origin;
    std::optional<io::VertexCacheUse> order;
    std::optional<io::TilesWritten> tiles;
};

void declare_write_report(DeclareFields<WriteReport>& d);

/// Converts to the unit and up axis that the options give, otherwise to the format's. Throws a stage error
/// (E-UNIT, E-UP) if an option gives a unit or axis and the scene has none. Warns of guesses.
void to_convention(Scene& scene, const WriteOptions& o, const io::Codec& codec, Context& context,
                   WriteReport& report);

/// Whether precision is automatic, coordinates may be too far from the origin for float32, and the format
/// stores all digits but no origin.
bool may_need_full(const WriteOptions& o, const io::Codec& codec, const Box& bounds);
/// The largest distance that float32 moves a world coordinate of the scene. O(vertices).
[[nodiscard]] double moved_by_floats(const Scene& scene);
/// Whether the rounding exceeds a millionth of the diagonal; if so, logs it.
bool needs_full(double rounding, const Box& bounds, Context& context);

/// For each material of the scene, the set of texture coordinates of its normal map, if any.
[[nodiscard]] std::vector<std::optional<int>> normal_map_uvs(const Scene& scene);
/// Adds tangents to a part if one of its materials has a normal map. Returns false, without a change, if the
/// part lacks a normal map, normals or texture coordinates, or if existing tangents must stay.
bool give_tangents(Part& part, const std::vector<std::optional<int>>& uvs_of_material, const WriteOptions& o,
                   Context& context);

/// Whether the user gave the position bits for a file with a grid.
bool bits_are_given(const io::WriteSettings& s);

/// Chooses the position bits per part for a file with a grid (Draco, quantize). The given or usual bits
/// apply to the scene or to each mesh. Bits that were not given grow until vertices stay distinct.
void choose_bits(io::WriteSettings& s, const io::Codec& codec, const Scene& scene, WriteReport& report);

/// Stages the files and reads the first file back. The first gets the pipeline's path, and the others go into
/// the same folder. Warns if the file read back is less sound than the scene. written: must contain a file.
[[nodiscard]] WrittenScene stage_files(const io::Written& written, const std::filesystem::path& path,
                                       const io::Codec& codec, const Scene& scene,
                                       const io::WriteSettings& settings, Context& context);

} // namespace facetmill::write_stage
