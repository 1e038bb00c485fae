#pragma once
// Detects scenes that differ only by a unit or an up axis.

#include "io/convert.hpp"

#include <string>

namespace facetmill::report {

/// The conventions of two scenes before the second was converted to the convention of the first.
struct Origin {
    io::Convention a, b;      ///< stated by the files themselves
    io::Conversion of_second; ///< the conversion applied, including the command line's values
};

/// A hint for scenes whose boxes match after a change of units, a rotation of the axes, or both: "the box of
/// B is that of A times 0.001 ...". Empty if the boxes are equal, or if no such conversion fits (corners
/// within a hundredth of the diagonal). Values from the command line for files without a statement are not
/// trusted: the hint applies to the original files. O(faces).
std::string conversion_hint(const Scene& a, const Scene& b, const Origin& origin);

} // namespace facetmill::report
