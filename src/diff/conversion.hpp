#pragma once
// Two scenes that differ by a unit or an up axis alone.

#include "io/convert.hpp"

#include <string>

namespace facetmill::report {

/// The conventions of two scenes before the second was converted to the first's.
struct Origin {
    io::Convention a, b;      ///< as the files themselves state
    io::Conversion of_second; ///< the conversion that was applied, including command-line options
};

/// What to do when the box of the second scene is that of the first times a factor between two units, or with
/// another up axis or otherwise turned about the axes, or both: "the box of B is that of A times 0.001 ...".
/// Empty when it is the same box, or no such conversion makes it so (corners within a hundredth of the
/// diagonal). Where a file states nothing, what the command line says of it is not taken for granted: the
/// hint is of the files as they are. O(faces).
std::string conversion_hint(const Scene& a, const Scene& b, const Origin& origin);

} // namespace facetmill::report
