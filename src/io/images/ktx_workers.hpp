#pragma once
// Runs the only program that facetmill starts: ktx or toktx of KTX-Software, which encode KTX2 textures. The
// sandbox forbids new processes, so dedicated worker processes start before the sandbox. Each waits for an
// image, runs the program in its own folder, and returns the file that the program wrote.

#include "io/bytes.hpp"

#include <chrono>

namespace facetmill::io {

/// The program in FACETMILL_KTX, otherwise ktx, otherwise toktx from PATH. None if it is not an executable
/// file.
[[nodiscard]] std::optional<std::filesystem::path> ktx_program();

/// Starts a worker per core, up to 8, if the program exists and no workers are running. Call it before
/// closing the sandbox and before starting threads.
void start_ktx_workers();

/// The settings for the program.
struct KtxOrder {
    bool uastc = false; ///< UASTC, supercompressed by Zstandard; otherwise ETC1S (BasisLZ)
    bool srgb = false;  ///< sRGB transfer function; otherwise linear
    bool alpha = false; ///< four channels; otherwise three
    int quality = 80;   ///< quality of ETC1S, 1 to 100
    std::chrono::seconds limit{600};
};

/// Encodes a PNG as a KTX2 file with all its levels. Thread-safe: each call waits for a free worker. Throws
/// a stage error (E-KTX) if the program is missing, fails, or exceeds the time limit.
[[nodiscard]] Bytes run_ktx(Span png, const KtxOrder& order);

} // namespace facetmill::io
