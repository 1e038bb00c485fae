#pragma once
// The one program that facetmill runs: ktx or toktx of KTX-Software, which encode KTX2 textures. The sandbox
// refuses new processes, so processes that do nothing else are started before it is closed: each waits for
// an image, runs the program on it in a folder of its own, and gives back what the program wrote.

#include "io/bytes.hpp"

#include <chrono>

namespace facetmill::io {

/// What FACETMILL_KTX names, else ktx, else toktx, as found in PATH; none when it is no program.
[[nodiscard]] std::optional<std::filesystem::path> ktx_program();

/// Starts as many such processes as there are cores, up to 8, when there is the program, and they are not
/// there yet. Call it before the sandbox is closed and before threads start.
void start_ktx_workers();

/// What the program is asked for.
struct KtxOrder {
    bool uastc = false; ///< UASTC, supercompressed by Zstandard; else ETC1S (BasisLZ)
    bool srgb = false;  ///< the transfer function of the texture; else linear
    bool alpha = false; ///< four channels; else three
    int quality = 80;   ///< of ETC1S, 1 to 100
    std::chrono::seconds limit{600};
};

/// The KTX2 file, with all its levels, of a PNG. Any thread may ask; each waits until a process is free.
/// Throws stage (E-KTX) when the program is not there, fails, or takes longer than the limit.
[[nodiscard]] Bytes run_ktx(Span png, const KtxOrder& order);

} // namespace facetmill::io
