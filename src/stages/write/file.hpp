#pragma once
// How write brings a scene into a file's convention and precision, and the file among the outputs of the run.

#include "stages/write/options.hpp"

namespace facetmill::write_stage {

struct WriteReport {
    struct Bits {
        int position_bits = 0; ///< of the part that has the most
        std::optional<int> least;
        std::string why;
    };
    std::optional<double> factor;
    std::optional<std::string> up;
    std::optional<Bits> draco, quantize;
    std::optional<OriginReport> origin;
    std::optional<io::VertexCacheUse> order;
    std::optional<io::TilesWritten> tiles;
};

void declare_write_report(DeclareFields<WriteReport>& d);

/// Converts to the file's convention, which the option or else the format says. Throws stage (E-UNIT, E-UP)
/// when the option asks for one and the scene has none; warns of guesses.
void to_convention(Scene& scene, const WriteOptions& o, const io::Codec& codec, Context& context,
                   WriteReport& report);

/// Whether precision is automatic, the format can have all digits and no origin of its own, and coordinates
/// may be too far from the origin for float32.
bool may_need_full(const WriteOptions& o, const io::Codec& codec, const Box& bounds);
/// How far float32 moves a coordinate of the scene, in the world, at most. O(vertices).
[[nodiscard]] double moved_by_floats(const Scene& scene);
/// Whether that is more than a millionth of the diagonal; says so.
bool needs_full(double rounding, const Box& bounds, Context& context);

/// By material of the scene, the set of texture coordinates that its map of normals reads, if it has one.
[[nodiscard]] std::vector<std::optional<int>> normal_map_uvs(const Scene& scene);
/// Gives a part tangents where a material of it has a map of normals. False, and nothing changed, where it
/// has none, or lacks normals or the texture coordinates, or has tangents already and they are to stay.
bool give_tangents(Part& part, const std::vector<std::optional<int>>& uvs_of_material, const WriteOptions& o,
                   Context& context);

/// Whether the user gave the bits of positions of a file with a grid.
bool bits_are_given(const io::WriteSettings& s, const WriteOptions& o);

/// Bits of position for a file with a grid (Draco, quantize), part by part: those that are given or usual, of
/// the scene or of each mesh, and, unless given, as many as keep vertices apart.
void choose_bits(io::WriteSettings& s, const WriteOptions& o, const io::Codec& codec, const Scene& scene,
                 WriteReport& report);

/// Stages the files, the first at the path as the pipeline names it and the others beside it, and reads the
/// first back. Warns when what is read is less sound than the scene.
void stage_files(const io::Written& written, const std::filesystem::path& path, const io::Codec& codec,
                 const Scene& scene, const io::WriteSettings& settings, Context& context);

} // namespace facetmill::write_stage
