#pragma once
// What main calls: it stands in the library, which is compiled with precompiled headers, and tests have a
// main of their own.

namespace facetmill::cli {

/// Runs the command line; the exit code of the process. Throws nothing.
int entry(int argc, char** argv);

} // namespace facetmill::cli
