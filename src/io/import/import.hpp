#pragma once
// Formats of others (FBX, STEP ...), read by helper programs. A parser of others never runs in this process:
// a helper gets the file in a sandbox and answers with a GLB, which is then read like any untrusted file.
//
// The helpers are separate executables, not libraries that this one loads. So the one executable stays
// static and small, and an installed helper shows what can be read without loading its libraries.

#include "io/codec.hpp"

namespace facetmill::io {

/// Starts worker processes that run the helpers, if any helper is installed and no workers are running. Call
/// it before closing the sandbox and before starting threads.
void start_import_workers();

/// From now on, helpers may read only these files and folders, besides the folder of their input if it is
/// below one of them. Call it once, while no helper runs. Without it, the sandbox of each helper decides.
void limit_import_workers(const std::vector<std::filesystem::path>& readable);

} // namespace facetmill::io
