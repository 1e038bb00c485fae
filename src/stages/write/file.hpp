#pragma once
// How write brings a scene into a file's convention and precision, and the file among the outputs of the run.

#include "stages/write/options.hpp"

namespace facetmill::write_stage {

struct WriteReport {
    struct Bits {
        int position_bits = 0;
        std::string why;
    };
    std::optional<double> factor;
    std::optional<std::string> up;
    std::optional<Bits> draco, quantize;
    std::optional<OriginReport> origin;
};

/// Converts to the file's convention, which the option or else the format says. Throws stage (E-UNIT, E-UP)
/// when the option asks for one and the scene has none; warns of guesses.
void to_convention(Scene& scene, const WriteOptions& o, const io::Codec& codec, Context& context,
                   WriteReport& report);

/// Bits of position for a file with a grid (Draco, quantize): those given, or as many as keep vertices apart.
void choose_bits(io::WriteSettings& s, const WriteOptions& o, const io::Codec& codec, const Scene& scene,
                 WriteReport& report);

/// Stages the files, the first at the path as the pipeline names it and the others beside it, and reads the
/// first back. Warns when what is read is less sound than the scene.
void stage_files(const io::Written& written, const std::filesystem::path& path, const io::Codec& codec,
                 const Scene& scene, const io::WriteSettings& settings, Context& context);

} // namespace facetmill::write_stage
